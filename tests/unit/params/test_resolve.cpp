#include <Teuchos_Array.hpp>
#include <Teuchos_UnitTestHarness.hpp>

#include "unit/params/example.hpp"

namespace {

using namespace tunica::params;
using namespace tunica::params::test;
using Teuchos::ParameterList;

TEUCHOS_UNIT_TEST(resolve, defaults_are_filled_in_at_all_depths) {
  ParameterList list;
  list.sublist("Fluid").sublist("Surfaces").sublist("inlet");
  case_table().resolve(list, "", "");
  const ParameterList& fluid = list.sublist("Fluid");
  TEST_EQUALITY(fluid.get<double>("density"), 1.05);
  TEST_EQUALITY(fluid.get<int>("max iterations"), 20);
  TEST_EQUALITY(fluid.get<bool>("is moving"), true);
  TEST_EQUALITY(fluid.get<std::string>("restart"), "");
  TEST_EQUALITY(fluid.get<Teuchos::Array<double>>("axis").size(), 3);
  TEST_EQUALITY(fluid.get<Teuchos::Array<std::string>>("tags")[1], "outlet");
  const ParameterList& inlet = fluid.sublist("Surfaces").sublist("inlet");
  TEST_EQUALITY(inlet.get<std::string>("condition"), "velocity");
  TEST_EQUALITY(inlet.get<double>("peak"), 0.0);
  TEST_EQUALITY(list.sublist("Belos").get<double>("Tolerance"), 1e-6);
  TEST_ASSERT(list.isSublist("MueLu"));
}

TEUCHOS_UNIT_TEST(resolve, a_second_time_changes_nothing) {
  ParameterList list;
  case_table().resolve(list, "", "");
  ParameterList again(list);
  case_table().resolve(again, "", "");
  TEST_ASSERT(Teuchos::haveSameValues(list, again));
}

TEUCHOS_UNIT_TEST(resolve, an_unknown_key_at_depth_three_names_its_list_and_the_nearest_key) {
  ParameterList list;
  list.sublist("Fluid").sublist("Surfaces").sublist("inlet").set("conditoin", "velocity");
  TEST_EQUALITY(resolve_message(case_table(), list),
                "Fluid / Surfaces / inlet: unknown key \"conditoin\". "
                "Did you mean \"condition\"?");
}

TEUCHOS_UNIT_TEST(resolve, an_unknown_key_far_from_all_lists_the_valid_ones) {
  ParameterList list;
  list.set("colour", 1);
  TEST_EQUALITY(resolve_message(case_table(), list),
                "unknown key \"colour\". Valid: \"Fluid\", \"Belos\", \"MueLu\".");
}

TEUCHOS_UNIT_TEST(resolve, a_wrong_type_is_described) {
  ParameterList list;
  list.set("density", "heavy");
  TEST_EQUALITY(resolve_message(fluid_table(), list, "Fluid"),
                "Fluid: \"density\" is the text \"heavy\", expected a number (double)");
  ParameterList other;
  other.set("max iterations", 2.5);
  TEST_EQUALITY(resolve_message(fluid_table(), other, "Fluid"),
                "Fluid: \"max iterations\" is the number 2.5, expected an integer (int)");
}

TEUCHOS_UNIT_TEST(resolve, a_list_in_place_of_a_value_and_the_reverse_are_errors) {
  ParameterList list;
  list.sublist("density");
  list.set("Surfaces", 1);
  TEST_EQUALITY(resolve_message(fluid_table(), list, "Fluid"),
                "Fluid: \"density\" is a parameter list, expected a number (double)\n"
                "Fluid: \"Surfaces\" is a parameter, expected a parameter list");
}

TEUCHOS_UNIT_TEST(resolve, integers_pass_for_numbers) {
  ParameterList list;
  list.set("density", 2);
  list.set("axis", array<int>({1, 0, 0}));
  fluid_table().resolve(list, "Fluid", "");
  TEST_EQUALITY(list.get<double>("density"), 2.0);
  TEST_EQUALITY(list.get<Teuchos::Array<double>>("axis")[0], 1.0);
}

TEUCHOS_UNIT_TEST(resolve, a_number_out_of_range_is_shown_with_its_unit) {
  ParameterList list;
  list.set("density", -1.0);
  list.set("max iterations", 101);
  TEST_EQUALITY(resolve_message(fluid_table(), list, "Fluid"),
                "Fluid: \"density\" is -1 mg/mm³, expected > 0\n"
                "Fluid: \"max iterations\" is 101, expected 1..100");
}

TEUCHOS_UNIT_TEST(resolve, numbers_must_be_finite) {
  ParameterList list;
  list.set("density", std::numeric_limits<double>::quiet_NaN());
  TEST_EQUALITY(resolve_message(fluid_table(), list, "Fluid"),
                "Fluid: \"density\" is nan mg/mm³, expected > 0");
}

TEUCHOS_UNIT_TEST(resolve, arrays_are_checked_for_length_and_range) {
  ParameterList list;
  list.set("axis", array<double>({1.0, 0.0}));
  TEST_EQUALITY(resolve_message(fluid_table(), list, "Fluid"),
                "Fluid: \"axis\" has 2 numbers, expected 3");
  list.set("axis", array<double>({1.0, 0.0, 2.0}));
  TEST_EQUALITY(resolve_message(fluid_table(), list, "Fluid"),
                "Fluid: \"axis\" contains 2, expected -1..1");
}

TEUCHOS_UNIT_TEST(resolve, a_choice_outside_its_options_lists_them) {
  ParameterList list;
  list.set("scheme", "bdf2");
  TEST_EQUALITY(resolve_message(fluid_table(), list, "Fluid"),
                "Fluid: \"scheme\" is \"bdf2\", expected one of \"implicit Euler\", \"BDF2\". "
                "Did you mean \"BDF2\"?");
}

TEUCHOS_UNIT_TEST(resolve, a_required_key_is_missed_with_what_it_means) {
  const Table table = Table().number("end", std::nullopt, positive(), "ms", "End of the run.");
  TEST_EQUALITY(resolve_message(table, ParameterList(), "Time"),
                "Time: \"end\" is missing, expected a number (double) > 0 [ms]. End of the run.");
}

TEUCHOS_UNIT_TEST(resolve, a_variant_adds_the_keys_of_its_case_only) {
  ParameterList list;
  list.set("condition", "traction");
  surface_table().resolve(list, "inlet", "");
  TEST_EQUALITY(list.get<double>("backflow stabilisation"), 0.2);
  TEST_ASSERT(!list.isParameter("peak"));
}

TEUCHOS_UNIT_TEST(resolve, a_key_of_another_case_says_to_which_it_belongs) {
  ParameterList list;
  list.set("backflow stabilisation", 0.2);
  TEST_EQUALITY(resolve_message(surface_table(), list, "Fluid / Surfaces / inlet"),
                "Fluid / Surfaces / inlet: \"backflow stabilisation\" belongs to \"condition\" = "
                "\"traction\", but it is \"velocity\"");
}

TEUCHOS_UNIT_TEST(resolve, of_nested_cases_the_nearest_to_the_choice_is_named) {
  const Table inner = Table().variant(
      "law", "linear", {{"linear", Table()}, {"cubic", Table().number("c", 1.0, any(), "", "C.")}},
      "Law.");
  const Table table = Table().variant("kind", "solid", {{"fluid", inner}, {"solid", inner}}, "K.");
  ParameterList list;
  list.set("c", 2.0);
  TEST_EQUALITY(resolve_message(table, list, "wall"),
                "wall: \"c\" belongs to \"law\" = \"cubic\", but it is \"linear\"");
}

TEUCHOS_UNIT_TEST(resolve, an_unknown_variant_does_not_blame_the_keys_of_its_cases) {
  ParameterList list;
  list.set("condition", "tractoin");
  list.set("backflow stabilisation", 0.2);
  TEST_EQUALITY(resolve_message(surface_table(), list, "inlet"),
                "inlet: \"condition\" is \"tractoin\", expected one of \"velocity\", "
                "\"traction\". Did you mean \"traction\"?");
}

TEUCHOS_UNIT_TEST(resolve, variants_nest_and_cases_have_checks) {
  const Table inner = Table().variant(
      "law", "linear", {{"linear", Table()}, {"cubic", Table().number("c", 1.0, any(), "", "C.")}},
      "Law.");
  const Table fails = Table().check(
      [](const ParameterList&, const std::string& path) { throw tunica::Error(path + ": never"); });
  const Table table = Table().variant("kind", "solid", {{"solid", inner}, {"bad", fails}}, "Kind.");
  ParameterList list;
  list.set("law", "cubic");
  table.resolve(list, "", "");
  TEST_EQUALITY(list.get<double>("c"), 1.0);
  ParameterList bad;
  bad.set("kind", "bad");
  TEST_EQUALITY(resolve_message(table, bad, "Wall"), "Wall: never");
}

TEUCHOS_UNIT_TEST(resolve, entries_have_free_names_but_must_be_lists) {
  ParameterList list;
  list.sublist("Surfaces").set("inlet", 1);
  TEST_EQUALITY(resolve_message(fluid_table(), list, "Fluid"),
                "Fluid / Surfaces: \"inlet\" is a parameter, expected parameter lists only");
}

TEUCHOS_UNIT_TEST(resolve, a_removed_key_names_its_successor) {
  ParameterList list;
  list.set("viscosity mu", 1.0);
  TEST_EQUALITY(resolve_message(fluid_table(), list, "Fluid"),
                "Fluid: \"viscosity mu\" no longer exists; use \"viscosity\"");
}

TEUCHOS_UNIT_TEST(resolve, checks_between_keys_run_once_the_keys_are_valid) {
  ParameterList list;
  list.set("density", 60);
  TEST_EQUALITY(resolve_message(fluid_table(), list, "Fluid"), "Fluid: too dense to move");
  list.set("max iterations", 0);
  TEST_EQUALITY(resolve_message(fluid_table(), list, "Fluid"),
                "Fluid: \"max iterations\" is 0, expected 1..100");
}

TEUCHOS_UNIT_TEST(resolve, all_errors_are_told_at_once_but_ten_at_most) {
  ParameterList list;
  for (int i = 0; i < 13; ++i) list.set("stranger " + std::to_string(i), i);
  const std::string message = resolve_message(Table(), list);
  TEST_EQUALITY(std::count(message.begin(), message.end(), '\n'), 10);
  TEST_ASSERT(message.find("... and 3 more") != std::string::npos);
}

TEUCHOS_UNIT_TEST(resolve, foreign_lists_are_checked_where_the_package_tells_its_keys) {
  ParameterList list;
  list.sublist("Belos").sublist("Output").set("Verbositty", 1);
  TEST_EQUALITY(resolve_message(case_table(), list),
                "Belos / Output: unknown key \"Verbositty\". Did you mean \"Verbosity\"?");
  ParameterList typed;
  typed.sublist("Belos").set("Tolerance", "small");
  TEST_EQUALITY(resolve_message(case_table(), typed),
                "Belos: \"Tolerance\" is the text \"small\", expected a value of type double");
}

TEUCHOS_UNIT_TEST(resolve, foreign_lists_stay_verbatim_and_unused) {
  ParameterList list;
  list.sublist("MueLu").set("smoother: type", "CHEBYSHEV");
  list.sublist("Belos").sublist("Output").set("Verbosity", 3);
  case_table().resolve(list, "", "");
  TEST_EQUALITY(list.sublist("MueLu").numParams(), 1);
  TEST_EQUALITY(list.sublist("Belos").numParams(), 1);
  TEST_ASSERT(!list.sublist("MueLu").getEntry("smoother: type").isUsed());
  TEST_ASSERT(!list.sublist("Belos").sublist("Output").getEntry("Verbosity").isUsed());
}

TEUCHOS_UNIT_TEST(resolve, file_names_start_at_the_folder_of_the_case) {
  const Folder folder;
  folder.file("state.h5", "x");
  ParameterList list;
  list.set("restart", "./state.h5");
  fluid_table().resolve(list, "Fluid", folder.path());
  TEST_EQUALITY(list.get<std::string>("restart"), folder.path("state.h5"));
}

TEUCHOS_UNIT_TEST(resolve, a_file_that_does_not_exist_is_an_error_with_the_full_name) {
  ParameterList list;
  list.set("restart", "absent.h5");
  const std::string message =
      message_of([&] { fluid_table().resolve(list, "Fluid", "/nowhere/at/all"); });
  TEST_EQUALITY(message,
                "Fluid: \"restart\" is \"absent.h5\", but \"/nowhere/at/all/absent.h5\" does not "
                "exist. Relative names start at the folder of the XML file");
  list.set("restart", "/tmp");
  TEST_EQUALITY(resolve_message(fluid_table(), list, "Fluid"),
                "Fluid: \"restart\" is \"/tmp\", but \"/tmp\" is not a file");
}

TEUCHOS_UNIT_TEST(resolve, a_required_file_must_not_be_empty) {
  const Table table = Table().file("mesh", std::nullopt, "Mesh.");
  ParameterList list;
  list.set("mesh", "");
  TEST_EQUALITY(resolve_message(table, list), "\"mesh\" is empty, expected the name of a file");
}

}  // namespace
