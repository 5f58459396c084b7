#include <Teuchos_UnitTestHarness.hpp>

#include "tunica/base/tensor.hpp"

namespace {

using namespace tunica;

const Mat3 A{{{2, 0, 1}, {1, 3, 0}, {0, 1, 4}}};  // det = 2·12 − 0 + 1·1 = 25

TEUCHOS_UNIT_TEST(tensor, cross_product_is_normal_to_its_factors) {
  const Vec3 a{1, 2, 3}, b{4, 5, 6}, c = cross(a, b);
  TEST_ASSERT(c == (Vec3{-3, 6, -3}));
  TEST_EQUALITY(dot(c, a), 0.0);
  TEST_EQUALITY(dot(c, b), 0.0);
}

TEUCHOS_UNIT_TEST(tensor, vectors_form_a_linear_space) {
  Vec3 a{1, 2, 3};
  TEST_ASSERT(a + Vec3({1, 1, 1}) == (Vec3{2, 3, 4}));
  TEST_ASSERT(a - Vec3({1, 1, 1}) == (Vec3{0, 1, 2}));
  TEST_ASSERT(2.0 * a == (Vec3{2, 4, 6}));
  a += Vec3{1, 0, 0};
  TEST_ASSERT(a == (Vec3{2, 2, 3}));
  TEST_EQUALITY(norm(Vec3{2, 3, 6}), 7.0);
}

TEUCHOS_UNIT_TEST(tensor, determinant_matches_expansion_by_hand) {
  TEST_EQUALITY(det(identity()), 1.0);
  TEST_EQUALITY(det(A), 25.0);
  TEST_EQUALITY(det(transpose(A)), 25.0);
  TEST_EQUALITY(det(Mat3{{{1, 2, 3}, {2, 4, 6}, {0, 1, 5}}}), 0.0);
}

TEUCHOS_UNIT_TEST(tensor, adjugate_times_matrix_is_the_determinant) {
  const Mat3 adj = adjugate(A);
  for (int j = 0; j < 3; ++j) {
    Vec3 e{};
    e[j] = 1.0;
    const Vec3 column = adj * (A * e);
    for (int i = 0; i < 3; ++i) TEST_EQUALITY(column[i], i == j ? 25.0 : 0.0);
  }
}

TEUCHOS_UNIT_TEST(tensor, a_matrix_acts_on_a_vector_by_rows) {
  TEST_ASSERT(A * Vec3({1, 2, 3}) == (Vec3{5, 7, 14}));
}

TEUCHOS_UNIT_TEST(tensor, swapping_two_vertices_turns_the_sign_of_a_volume) {
  const Vec3 a{1, 1, 1}, b{2, 1, 1}, c{1, 2, 1}, d{1, 1, 4};
  TEST_EQUALITY(signed_volume(a, b, c, d), 0.5);
  TEST_EQUALITY(signed_volume(a, c, b, d), -0.5);
}

}  // namespace
