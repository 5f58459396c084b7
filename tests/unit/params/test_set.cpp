#include <Teuchos_Array.hpp>
#include <Teuchos_UnitTestHarness.hpp>

#include "tunica/params/read_xml.hpp"
#include "unit/params/example.hpp"

namespace {

using namespace tunica::params;
using namespace tunica::params::test;
using Teuchos::ParameterList;

ParameterList after(const std::string& assignment) {
  ParameterList list;
  set_from_text(list, case_table(), assignment);
  return list;
}

std::string refused(const std::string& assignment) {
  const std::string message = message_of([&] { after(assignment); });
  const std::string start = "--set \"" + assignment + "\": ";
  return message.rfind(start, 0) == 0 ? message.substr(start.size()) : message;
}

TEUCHOS_UNIT_TEST(set_from_text, the_table_gives_the_type) {
  TEST_EQUALITY(after("Fluid/density=1").sublist("Fluid").get<double>("density"), 1.0);
  TEST_EQUALITY(after("Fluid/max iterations=7").sublist("Fluid").get<int>("max iterations"), 7);
  TEST_EQUALITY(after("Fluid / is moving = false").sublist("Fluid").get<bool>("is moving"), false);
  TEST_EQUALITY(after("Fluid/title=a=b").sublist("Fluid").get<std::string>("title"), "a=b");
}

TEUCHOS_UNIT_TEST(set_from_text, arrays_need_no_braces) {
  using Numbers = Teuchos::Array<double>;
  TEST_EQUALITY(after("Fluid/axis=1,0, 0.5").sublist("Fluid").get<Numbers>("axis")[2], 0.5);
  TEST_EQUALITY(after("Fluid/axis={1,0,0.5}").sublist("Fluid").get<Numbers>("axis")[2], 0.5);
  using Names = Teuchos::Array<std::string>;
  TEST_EQUALITY(after("Fluid/tags=a, b").sublist("Fluid").get<Names>("tags")[1], "b");
}

TEUCHOS_UNIT_TEST(set_from_text, keys_of_every_case_of_a_variant_exist) {
  const ParameterList list = after("Fluid/Surfaces/inlet/backflow stabilisation=0.1");
  const ParameterList& inlet = list.sublist("Fluid").sublist("Surfaces").sublist("inlet");
  TEST_EQUALITY(inlet.get<double>("backflow stabilisation"), 0.1);
}

TEUCHOS_UNIT_TEST(set_from_text, a_misspelt_entry_does_not_become_a_new_one) {
  ParameterList list = after("Fluid/Surfaces/inlet/peak=1");
  TEST_EQUALITY(
      message_of([&] { set_from_text(list, case_table(), "Fluid/Surfaces/inlt/peak=1"); }),
      "--set \"Fluid/Surfaces/inlt/peak=1\": Fluid / Surfaces: there is no \"inlt\" in "
      "the file. Did you mean \"inlet\"?");
}

TEUCHOS_UNIT_TEST(set_from_text, unknown_keys_name_the_nearest) {
  TEST_EQUALITY(refused("fluid/density=1"), "unknown key \"fluid\". Did you mean \"Fluid\"?");
  TEST_EQUALITY(refused("Fluid/Density=1"),
                "Fluid: unknown key \"Density\". Did you mean \"density\"?");
  TEST_EQUALITY(refused("Fluid/viscosity mu=1"),
                "Fluid: \"viscosity mu\" no longer exists; use \"viscosity\"");
}

TEUCHOS_UNIT_TEST(set_from_text, a_text_of_another_type_is_refused) {
  TEST_EQUALITY(refused("Fluid/density=heavy"),
                "Fluid: \"density\" cannot be \"heavy\", expected a number (double)");
  TEST_EQUALITY(refused("Fluid/max iterations=2.5"),
                "Fluid: \"max iterations\" cannot be \"2.5\", expected an integer (int)");
}

TEUCHOS_UNIT_TEST(set_from_text, the_path_must_end_at_a_parameter) {
  TEST_EQUALITY(refused("Fluid=1"), "\"Fluid\" is a list; name a key in it");
  TEST_EQUALITY(refused("Fluid/density/x=1"), "Fluid: \"density\" is a parameter, not a list");
  TEST_EQUALITY(refused("Fluid/density"), "expected \"List/key=value\"");
  TEST_EQUALITY(refused("Fluid//density=1"), "a name is empty, expected \"List/key=value\"");
}

TEUCHOS_UNIT_TEST(set_from_text, foreign_lists_keep_their_default_and_declared_types) {
  const ParameterList belos = after("Belos/Output/Verbosity=3").sublist("Belos");
  TEST_EQUALITY(belos.sublist("Output").get<int>("Verbosity"), 3);
  TEST_EQUALITY(belos.get<double>("Tolerance"), 1e-6);
  TEST_EQUALITY(after("Belos/Tolerance=1").sublist("Belos").get<double>("Tolerance"), 1.0);
  TEST_EQUALITY(refused("Belos/Tolerence=1"),
                "Belos: unknown key \"Tolerence\". Did you mean \"Tolerance\"?");
}

TEUCHOS_UNIT_TEST(set_from_text, types_of_undeclared_foreign_keys_follow_the_text) {
  const auto muelu = [](const std::string& text) {
    return after("MueLu/a: b/x=" + text).sublist("MueLu").sublist("a: b");
  };
  TEST_EQUALITY(muelu("3").get<int>("x"), 3);
  TEST_EQUALITY(muelu("0.5").get<double>("x"), 0.5);
  TEST_EQUALITY(muelu("true").get<bool>("x"), true);
  TEST_EQUALITY(muelu("ILUT").get<std::string>("x"), "ILUT");
  TEST_EQUALITY(muelu("{1, 2}").get<Teuchos::Array<int>>("x")[1], 2);
}

}  // namespace
