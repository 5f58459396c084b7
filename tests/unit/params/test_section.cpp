#include <Teuchos_UnitTestHarness.hpp>
#include <sstream>

#include "tunica/base/error.hpp"
#include "tunica/params/section.hpp"
#include "tunica/params/table.hpp"

namespace {

using namespace tunica;

std::string reference() {
  params::Table load, each, fluid, table;
  load.number("period", 0.0, params::any(), "ms", "of the load");
  each.number("pressure", 1.0, params::any(), "kPa", "on it").sublist("Amplitude", load);
  fluid.number("density", 1.0, params::positive(), "mg/mm^3", "of the fluid")
      .entries("Surfaces", each, "one list for each");
  table.sublist("Fluid", fluid).sublist("Time", params::Table("steps"));
  std::ostringstream text;
  table.print_markdown(text, "Case");
  return text.str();
}

std::string refusal(const std::string& path) {
  try {
    params::section_of(reference(), path);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

bool holds(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEUCHOS_UNIT_TEST(section, is_the_list_with_what_is_in_it) {
  const std::string all = params::section_of(reference(), "Fluid");
  TEST_ASSERT(holds(all, "| `density`") && holds(all, "| `pressure`"));
  TEST_ASSERT(!holds(all, "steps"));
  const std::string surfaces = params::section_of(reference(), "Fluid / Surfaces");
  TEST_ASSERT(!holds(surfaces, "| `density`") && holds(surfaces, "| `pressure`"));
  TEST_EQUALITY(params::section_of(reference(), "Fluid/Surfaces/inlet"), surfaces);
  TEST_ASSERT(
      !holds(params::section_of(reference(), "Fluid/Surfaces/inlet/Amplitude"), "pressure"));
}

TEUCHOS_UNIT_TEST(section, prints_a_list_of_several_choices_once) {
  params::Table load, pushed, flowing, each, table;
  load.number("period", 0.0, params::any(), "ms", "of the load");
  pushed.number("pressure", 1.0, params::any(), "kPa", "on it").sublist("Amplitude", load);
  flowing.number("flow", 1.0, params::any(), "mm^3/ms", "into it").sublist("Amplitude", load);
  each.variant("condition", "pushed", {{"pushed", pushed}, {"flowing", flowing}}, "what it has");
  table.entries("Surfaces", each, "one list for each");
  std::ostringstream full;
  table.print_markdown(full, "Case");
  const std::string text = params::section_of(full.str(), "Surfaces");
  TEST_ASSERT(holds(text, "| `pressure`") && holds(text, "| `flow`"));
  TEST_EQUALITY(text.find("| `period`"), text.rfind("| `period`"));
  TEST_ASSERT(holds(text, "| `period`"));
}

TEUCHOS_UNIT_TEST(section, of_a_key_is_its_row) {
  const std::string row = params::section_of(reference(), "Fluid/density");
  TEST_ASSERT(holds(row, "of the fluid") && !holds(row, "Surfaces"));
}

TEUCHOS_UNIT_TEST(section, nearest_name_is_proposed) {
  TEST_ASSERT(holds(refusal("Fluid/Surfces"), "Did you mean \"Surfaces\"?"));
  TEST_ASSERT(holds(refusal("fluid"), "Did you mean \"Fluid\"?"));
  TEST_ASSERT(holds(refusal("Fluid/densty"), "Did you mean \"density\"?"));
  TEST_ASSERT(holds(refusal("Fluid/Surfaces/inlet/presure"), "Did you mean \"pressure\"?"));
  TEST_ASSERT(holds(refusal("Whole"), "Valid: \"Fluid\", \"Time\""));
}

}  // namespace
