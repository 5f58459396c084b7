#include <Teuchos_UnitTestHarness.hpp>

#include "tunica/base/error.hpp"
#include "tunica/run/domain.hpp"
#include "unit/fields/small_tube.hpp"
#include "unit/judge/sanity_cases.hpp"

namespace {

using namespace tunica;
using test::condition;
using test::number;
using test::sublist;
using test::text;

/// What the checks say of a fluid alone in the small tube with this at its ends.
std::string said_of(const std::string& ends, const std::string& time = "") {
  Teuchos::ParameterList list = *Teuchos::getParametersFromXmlString(sublist(
      "Case",
      sublist("Mesh", text("file", TUNICA_MESHES "/tube-tiny.h5")) +
          sublist("Time", time + number("step size", "10") +
                              "<Parameter name=\"steps\" type=\"int\" value=\"40\"/>") +
          sublist("Fluid", number("density", "1") + number("viscosity", "0.004") +
                               sublist("Surfaces", ends + condition("interface", "no slip")))));
  setup::fluid_table().resolve(list, "", "");
  const test::SmallTube tube;
  run::Domain domain;
  domain.meshes.emplace("fluid", tube.fluid);
  try {
    run::check_fields(list, domain);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

std::string flow(const std::string& surface, const std::string& rate,
                 const std::string& amplitude = "") {
  return condition(surface, "flow rate", number("flow rate", rate) + amplitude);
}

TEUCHOS_UNIT_TEST(check_fields, flows_through_a_fluid_that_is_closed_must_balance_at_all_times) {
  const auto lets_nothing_out = [](const std::string& said) {
    return said.find("flow into a fluid without an open surface") != std::string::npos;
  };
  const std::string in = flow("inlet", "2"), shut = condition("outlet", "no slip");
  TEST_ASSERT(lets_nothing_out(said_of(in + shut)));
  TEST_ASSERT(lets_nothing_out(said_of(in + shut, text("step control", "steady"))));
  const std::string late = test::table_of("0, 300, 310, 330, 340", "0, 0, 1, 1, 0");
  TEST_ASSERT(lets_nothing_out(said_of(flow("inlet", "2", late) + shut)));
  TEST_EQUALITY(said_of(in + flow("outlet", "-2")), "");
  TEST_EQUALITY(said_of(in + condition("outlet", "pressure", number("pressure", "0"))), "");
}

}  // namespace
