#include <Teuchos_UnitTestHarness.hpp>

#include "tunica/algebra/least_squares.hpp"
#include "unit/fields/small_tube.hpp"

namespace {

using namespace tunica;

/// The calling rank's entries of a global vector: rank r has r, r + ranks, r + 2 ranks, ...
std::vector<double> share(const std::vector<double>& all, const Comm& comm) {
  std::vector<double> mine;
  for (std::size_t i = comm.getRank(); i < all.size(); i += comm.getSize()) mine.push_back(all[i]);
  return mine;
}

std::deque<std::vector<double>> shares(const std::vector<std::vector<double>>& columns,
                                       const Comm& comm) {
  std::deque<std::vector<double>> mine;
  for (const auto& column : columns) mine.push_back(share(column, comm));
  return mine;
}

TEUCHOS_UNIT_TEST(least_squares, fits_a_line_as_by_hand) {
  // Values 1, 3, 2, 5 at 0, 1, 2, 3: intercept 1.1, slope 1.1.
  const Comm& comm = *test::world();
  const auto fit = algebra::solve_least_squares(comm, shares({{1, 1, 1, 1}, {0, 1, 2, 3}}, comm),
                                                share({1, 3, 2, 5}, comm), 1e-7);
  TEST_FLOATING_EQUALITY(fit.coefficients[0], 1.1, 1e-14);
  TEST_FLOATING_EQUALITY(fit.coefficients[1], 1.1, 1e-14);
  TEST_ASSERT(fit.is_kept[0] && fit.is_kept[1]);
}

TEUCHOS_UNIT_TEST(least_squares, dependent_columns_get_no_coefficient) {
  const Comm& comm = *test::world();
  const auto fit = algebra::solve_least_squares(
      comm, shares({{1, 0, 0, 0}, {2, 1e-9, 0, 0}, {0, 0, 0, 0}, {0, 1, 1, 0}}, comm),
      share({3, 4, 4, 9}, comm), 1e-7);
  TEST_ASSERT(fit.is_kept == std::vector<char>({1, 0, 0, 1}));
  TEST_FLOATING_EQUALITY(fit.coefficients[0], 3.0, 1e-14);
  TEST_EQUALITY(fit.coefficients[1], 0.0);
  TEST_EQUALITY(fit.coefficients[2], 0.0);
  TEST_FLOATING_EQUALITY(fit.coefficients[3], 4.0, 1e-14);
}

TEUCHOS_UNIT_TEST(least_squares, no_columns_are_no_coefficients) {
  const Comm& comm = *test::world();
  const auto fit = algebra::solve_least_squares(comm, {}, share({1, 2}, comm), 1e-7);
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
      algebra::solve_least_squares(comm, shares({v, near}, comm), share(b, comm), 1e-8);
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
  const auto a = algebra::solve_least_squares(*many, shares(columns, *many), share(b, *many), 1e-7);
  const auto c = algebra::solve_least_squares(*one, shares(columns, *one), share(b, *one), 1e-7);
  for (int j = 0; j < 6; ++j)
    TEST_FLOATING_EQUALITY(a.coefficients[j] + 2.0, c.coefficients[j] + 2.0, 1e-13);
}

}  // namespace
