#include <Teuchos_UnitTestHarness.hpp>
#include <Teuchos_XMLParameterListHelpers.hpp>

#include "tunica/setup/one_field.hpp"
#include "unit/judge/sanity_cases.hpp"

namespace {

using namespace tunica;
using test::condition;
using test::sublist;
using test::text;

Teuchos::ParameterList coupled() {
  const std::string surfaces =
      sublist("Surfaces", condition("end", "clamped") + condition("inside", "interface"));
  const std::string probes = sublist("a", text("quantity", "fluid pressure")) +
                             sublist("b", text("quantity", "wall displacement"));
  return *Teuchos::getParametersFromXmlString(
      sublist("Case", sublist("Fluid", surfaces) + sublist("Wall", surfaces) +
                          sublist("Coupling", "") + sublist("Probes", probes)));
}

TEUCHOS_UNIT_TEST(one_field, wall_is_left_free_on_the_interface) {
  Teuchos::ParameterList list = coupled();
  const std::string said = setup::leave_one_field(list, "tunica-solid");
  TEST_EQUALITY(said,
                "tunica-solid ignores Fluid, Coupling of this case and solves the wall alone, free "
                "on inside. tunica-fsi couples both.");
  TEST_ASSERT(!list.isSublist("Fluid") && !list.isSublist("Coupling"));
  TEST_ASSERT(!list.sublist("Wall").sublist("Surfaces").isSublist("inside"));
  TEST_ASSERT(!list.sublist("Probes").isSublist("a") && list.sublist("Probes").isSublist("b"));
}

TEUCHOS_UNIT_TEST(one_field, fluid_is_left_in_rigid_walls) {
  Teuchos::ParameterList list = coupled();
  const std::string said = setup::leave_one_field(list, "tunica-fluid");
  TEST_INEQUALITY(said.find("in rigid walls on inside"), std::string::npos);
  TEST_EQUALITY(
      list.sublist("Fluid").sublist("Surfaces").sublist("inside").get<std::string>("condition"),
      "no slip");
  TEST_ASSERT(list.sublist("Probes").isSublist("a") && !list.sublist("Probes").isSublist("b"));
}

TEUCHOS_UNIT_TEST(one_field, other_cases_and_programs_are_left_alone) {
  Teuchos::ParameterList list = coupled();
  TEST_EQUALITY(setup::leave_one_field(list, "tunica-fsi"), "");
  list.remove("Fluid");
  TEST_EQUALITY(setup::leave_one_field(list, "tunica-solid"), "");
  TEST_ASSERT(list.isSublist("Coupling"));  // which then is refused, as it was
}

}  // namespace
