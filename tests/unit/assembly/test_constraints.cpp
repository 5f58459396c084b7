#include <Teuchos_UnitTestHarness.hpp>
#include <cmath>

#include "tunica/assembly/constraints.hpp"

namespace {

using namespace tunica;
using assembly::Constraints;

const Vec3 across{2.0 / 3.0, -1.0 / 3.0, 2.0 / 3.0};

TEUCHOS_UNIT_TEST(constraints, components_are_dropped_and_the_others_stay_as_they_are) {
  Constraints fixed(2);
  fixed.fix_component(0, 1);
  fixed.fix_scalar(0);
  TEST_ASSERT(fixed.project(0, {1.0, 2.0, 3.0}) == (Vec3{1.0, 0.0, 3.0}));
  TEST_ASSERT(fixed.is_fixed(0, 1) && !fixed.is_fixed(0, 0) && fixed.is_scalar_fixed(0));
  TEST_ASSERT(fixed.oblique(0) == nullptr && fixed.is_free(1));
  fixed.fix_vector(0);
  TEST_ASSERT(fixed.project(0, {1.0, 2.0, 3.0}) == (Vec3{}) && fixed.is_scalar_fixed(0));
}

TEUCHOS_UNIT_TEST(constraints, a_plane_across_the_axes_keeps_what_lies_in_it) {
  Constraints fixed(1);
  fixed.fix_direction(0, across);
  const Vec3 in_plane = cross(across, Vec3{1.0, 0.0, 0.0});
  TEST_COMPARE(norm(fixed.project(0, 3.0 * across + in_plane) - in_plane), <, 1e-14);
  TEST_ASSERT(fixed.oblique(0) != nullptr && !fixed.is_fixed(0, 0) && !fixed.is_free(0));
}

TEUCHOS_UNIT_TEST(constraints, two_planes_leave_the_line_in_which_they_meet) {
  Constraints fixed(1);
  fixed.fix_component(0, 2);
  fixed.fix_direction(0, across);
  const Vec3 line = cross(across, Vec3{0.0, 0.0, 1.0});
  const Vec3 free = fixed.project(0, {1.0, 1.0, 1.0});
  TEST_COMPARE(norm(cross(free, line)), <, 1e-14);
  TEST_COMPARE(norm(free), >, 0.1);
  TEST_ASSERT(fixed.is_fixed(0, 2));
}

TEUCHOS_UNIT_TEST(constraints, three_directions_leave_nothing) {
  Constraints fixed(1);
  fixed.fix_direction(0, across);
  fixed.fix_direction(0, {0.6, 0.8, 0.0});
  fixed.fix_direction(0, {0.0, 0.6, -0.8});
  for (int i = 0; i < 3; ++i) TEST_ASSERT(fixed.is_fixed(0, i));
  TEST_ASSERT(fixed.oblique(0) == nullptr);
}

// Planes of a mesh whose numbers are rounded.
TEUCHOS_UNIT_TEST(constraints, directions_that_are_nearly_one_are_one) {
  Constraints fixed(2);
  Vec3 near = across + Vec3{1e-3, 2e-3, 0.0};
  near = 1.0 / norm(near) * near;
  fixed.fix_direction(0, across);
  fixed.fix_direction(0, near);
  const Vec3 in_plane = cross(across, Vec3{0.0, 1.0, 0.0});
  TEST_COMPARE(norm(fixed.project(0, in_plane) - in_plane), <, 1e-14);
  fixed.fix_component(1, 2);
  fixed.fix_direction(1, {1e-4, 0.0, std::sqrt(1.0 - 1e-8)});
  TEST_ASSERT(fixed.oblique(1) == nullptr);
  TEST_ASSERT(fixed.project(1, {1.0, 2.0, 3.0}) == (Vec3{1.0, 2.0, 0.0}));
}

}  // namespace
