#include <Teuchos_UnitTestHarness.hpp>

#include "tunica/base/error.hpp"
#include "tunica/observe/force_groups.hpp"

namespace {

using namespace tunica;

Teuchos::ParameterList case_with(const std::vector<double>& drag, double per_length) {
  Teuchos::ParameterList the_case;
  Teuchos::ParameterList& output = the_case.sublist("Output");
  Teuchos::ParameterList& group = output.sublist("Force Groups").sublist("body");
  group.set("surfaces",
            Teuchos::Array<std::string>(Teuchos::tuple<std::string>("cylinder", "beam")));
  group.set("drag", Teuchos::Array<double>(drag)).set("per length", per_length);
  params::Table table;
  observe::add_force_group_keys(table);
  table.resolve(output, "Output", "");
  return the_case;
}

TEUCHOS_UNIT_TEST(force_groups, drag_and_lift_are_sums_over_surfaces_along_directions) {
  discretisation::Observables columns{{"pressure_force_other_x_mN", 100.0}};
  discretisation::add_vector("pressure_force_cylinder", "mN", {1.0, 2.0, 4.0}, columns);
  discretisation::add_vector("viscous_force_cylinder", "mN", {0.1, 0.2, 0.4}, columns);
  discretisation::add_vector("pressure_force_beam", "mN", {10.0, 20.0, 40.0}, columns);
  discretisation::add_vector("viscous_force_beam", "mN", {0.01, 0.02, 0.04}, columns);
  const auto groups = observe::force_groups_in(case_with({3.0, 0.0, 4.0}, 0.0));
  const auto found = observe::summed_forces(groups, columns);
  TEST_EQUALITY(found.size(), 2u);
  TEST_EQUALITY(found[0].name, "drag_body_mN");
  TEST_EQUALITY(found[1].name, "lift_body_mN");
  TEST_FLOATING_EQUALITY(found[0].value, 0.6 * 11.11 + 0.8 * 44.44, 1e-14);
  TEST_FLOATING_EQUALITY(found[1].value, 22.22, 1e-14);
  const auto per_mm =
      observe::summed_forces(observe::force_groups_in(case_with({1.0, 0.0, 0.0}, 4.0)), columns);
  TEST_EQUALITY(per_mm[0].name, "drag_body_mN_per_mm");
  TEST_FLOATING_EQUALITY(per_mm[0].value, 11.11 / 4.0, 1e-14);
  TEST_ASSERT(observe::surfaces_of(groups) == (std::vector<std::string>{"cylinder", "beam"}));
}

TEUCHOS_UNIT_TEST(force_groups, refuse_what_is_no_direction) {
  TEST_THROW(case_with({0.0, 0.0, 0.0}, 0.0), Error);
  TEST_THROW(case_with({1.0, 0.0}, 0.0), Error);
  TEST_THROW(case_with({1.0, 0.0, 0.0}, -1.0), Error);
}

}  // namespace
