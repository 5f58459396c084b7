#include <Teuchos_UnitTestHarness.hpp>

#include "tunica/params/nearest.hpp"

namespace {

using namespace tunica::params;

TEUCHOS_UNIT_TEST(nearest, a_swap_of_neighbours_is_one_edit) {
  TEST_EQUALITY(edit_distance("modulus", "moduuls"), 1);
  TEST_EQUALITY(edit_distance("modulus", "modulos"), 1);
  TEST_EQUALITY(edit_distance("", "abc"), 3);
  TEST_EQUALITY(edit_distance("kitten", "sitting"), 3);
}

TEUCHOS_UNIT_TEST(nearest, other_capitals_are_preferred_to_other_letters) {
  TEST_EQUALITY(nearest("density", {"densite", "Density"}), "Density");
}

TEUCHOS_UNIT_TEST(nearest, distance_two_is_near_and_three_is_not) {
  TEST_EQUALITY(nearest("bulk modulo", {"shear modulus", "bulk modulus"}), "bulk modulus");
  TEST_EQUALITY(nearest("bulk mod", {"bulk modulus"}), "");
}

TEUCHOS_UNIT_TEST(nearest, short_names_are_not_replaced_wholly) {
  TEST_EQUALITY(nearest("dt", {"h", "x"}), "");
}

TEUCHOS_UNIT_TEST(nearest, without_a_near_name_all_are_listed) {
  TEST_EQUALITY(did_you_mean("outlett", {"inlet", "outlet"}), "Did you mean \"outlet\"?");
  TEST_EQUALITY(did_you_mean("colour", {"inlet", "wall"}), "Valid: \"inlet\", \"wall\".");
}

}  // namespace
