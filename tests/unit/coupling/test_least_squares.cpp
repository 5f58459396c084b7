#include <Teuchos_UnitTestHarness.hpp>

#include "tunica/coupling/least_squares.hpp"
#include "unit/coupling/interface_vector.hpp"

namespace {

using namespace tunica;
using coupling::InterfaceVector;

std::deque<InterfaceVector> shares(const std::vector<std::vector<double>>& columns,
                                   const Comm& comm) {
  std::deque<InterfaceVector> mine;
  for (const auto& column : columns) mine.push_back(test::share(column, comm));
  return mine;
}

TEUCHOS_UNIT_TEST(least_squares, fits_a_line_as_by_hand) {
  // Values 1, 3, 2, 5 at 0, 1, 2, 3: intercept 1.1, slope 1.1.
  const Comm& comm = *test::world();
  const auto fit = coupling::solve_least_squares(comm, shares({{1, 1, 1, 1}, {0, 1, 2, 3}}, comm),
                                                 test::share({1, 3, 2, 5}, comm), 1e-7);
  TEST_FLOATING_EQUALITY(fit.coefficients[0], 1.1, 1e-14);
  TEST_FLOATING_EQUALITY(fit.coefficients[1], 1.1, 1e-14);
  TEST_ASSERT(fit.is_kept[0] && fit.is_kept[1]);
}

TEUCHOS_UNIT_TEST(least_squares, dependent_columns_get_no_coefficient) {
  const Comm& comm = *test::world();
  const auto fit = coupling::solve_least_squares(
      comm, shares({{1, 0, 0, 0}, {2, 1e-9, 0, 0}, {0, 0, 0, 0}, {0, 1, 1, 0}}, comm),
      test::share({3, 4, 4, 9}, comm), 1e-7);
  TEST_ASSERT(fit.is_kept == std::vector<char>({1, 0, 0, 1}));
  TEST_FLOATING_EQUALITY(fit.coefficients[0], 3.0, 1e-14);
  TEST_EQUALITY(fit.coefficients[1], 0.0);
  TEST_EQUALITY(fit.coefficients[2], 0.0);
  TEST_FLOATING_EQUALITY(fit.coefficients[3], 4.0, 1e-14);
}

TEUCHOS_UNIT_TEST(least_squares, no_columns_are_no_coefficients) {
  const Comm& comm = *test::world();
  const auto fit = coupling::solve_least_squares(comm, {}, test::share({1, 2}, comm), 1e-7);
  TEST_ASSERT(fit.coefficients.empty() && fit.is_kept.empty());
}

TEUCHOS_UNIT_TEST(least_squares, nearly_dependent_columns_keep_their_accuracy) {
  // v and v + 1e-6 w: the coefficients of b = 2 v + 1 (v + 1e-6 w) are 2 and 1.
  std::vector<double> v(40), near(40), b(40);
  for (int i = 0; i < 40; ++i) {
    v[i] = test::scatter(i);
    near[i] = v[i] + 1e-6 * test::scatter(100 + i);
    b[i] = 2.0 * v[i] + near[i];
  }
  const Comm& comm = *test::world();
  const auto fit =
      coupling::solve_least_squares(comm, shares({v, near}, comm), test::share(b, comm), 1e-8);
  TEST_FLOATING_EQUALITY(fit.coefficients[0], 2.0, 1e-8);
  TEST_FLOATING_EQUALITY(fit.coefficients[1], 1.0, 1e-8);
}

TEUCHOS_UNIT_TEST(least_squares, result_is_independent_of_ranks) {
  std::vector<std::vector<double>> columns(6, std::vector<double>(50));
  std::vector<double> b(50);
  for (int i = 0; i < 50; ++i) {
    for (int j = 0; j < 6; ++j) columns[j][i] = test::scatter(60.0 * j + i);
    b[i] = test::scatter(1000.0 + i);
  }
  const CommPtr many = test::world(), one = test::alone();
  const auto a =
      coupling::solve_least_squares(*many, shares(columns, *many), test::share(b, *many), 1e-7);
  const auto c =
      coupling::solve_least_squares(*one, shares(columns, *one), test::share(b, *one), 1e-7);
  for (int j = 0; j < 6; ++j)
    TEST_FLOATING_EQUALITY(a.coefficients[j] + 2.0, c.coefficients[j] + 2.0, 1e-13);
}

}  // namespace
