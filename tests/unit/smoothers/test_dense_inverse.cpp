#include <Teuchos_LAPACK.hpp>
#include <Teuchos_UnitTestHarness.hpp>
#include <cmath>
#include <limits>

#include "tunica/smoothers/dense/dense.hpp"
#include "unit/fields/small_tube.hpp"

namespace {

using namespace tunica;
using Dense = std::vector<double>;  ///< row by row

Dense scattered(int n, double diagonal = 0.0) {
  Dense a(static_cast<std::size_t>(n) * n);
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      a[i * n + j] = test::scatter(100.0 * n + 13.7 * i + 1.31 * j) + (i == j ? diagonal : 0.0);
  return a;
}

/// The mixed shape of a patch: [A Bᵀ; B 0] with one pressure.
Dense saddle(int n) {
  Dense a = scattered(n, n);
  a[n * n - 1] = 0.0;
  return a;
}

double distance_from_identity(int n, const Dense& a, const Dense& b) {
  double largest = 0.0;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      double product = i == j ? -1.0 : 0.0;
      for (int k = 0; k < n; ++k) product += a[i * n + k] * b[k * n + j];
      largest = std::max(largest, std::abs(product));
    }
  return largest;
}

/// By LU factors with row exchanges. Of the transpose: Fortran reads our rows as columns.
Dense lapack_inverse(int n, Dense a) {
  std::vector<int> exchanged(n);
  Dense work(64 * n);
  int info = 0;
  Teuchos::LAPACK<int, double> lapack;
  lapack.GETRF(n, n, a.data(), n, exchanged.data(), &info);
  lapack.GETRI(n, a.data(), n, exchanged.data(), work.data(), 64 * n, &info);
  return a;
}

TEUCHOS_UNIT_TEST(dense_inverse, is_that_of_lapack) {
  smoothers::DenseScratch scratch;
  for (const int n : {1, 2, 3, 4, 5, 7, 8, 31, 46, 64})
    for (const Dense& a : {scattered(n), scattered(n, n), saddle(n + 1)}) {
      const int size = static_cast<int>(std::lround(std::sqrt(a.size())));
      Dense inverse(a);
      TEST_ASSERT(smoothers::invert_dense(size, inverse.data(), scratch));
      TEST_COMPARE(distance_from_identity(size, a, inverse), <, 1e-10);
      TEST_COMPARE(distance_from_identity(size, inverse, a), <, 1e-10);
      const Dense expected = lapack_inverse(size, a);
      double error = 0.0, scale = 0.0;
      for (std::size_t i = 0; i < a.size(); ++i) {
        error = std::max(error, std::abs(inverse[i] - expected[i]));
        scale = std::max(scale, std::abs(expected[i]));
      }
      TEST_COMPARE(error, <, 1e-10 * scale);
    }
}

TEUCHOS_UNIT_TEST(dense_inverse, rows_are_exchanged_where_the_diagonal_is_zero) {
  smoothers::DenseScratch scratch;
  Dense cycle{0, 2, 0, 0, 0, 4, 8, 0, 0};  // y = (2 x_1, 4 x_2, 8 x_0)
  TEST_ASSERT(smoothers::invert_dense(3, cycle.data(), scratch));
  TEST_ASSERT((cycle == Dense{0, 0, 0.125, 0.5, 0, 0, 0, 0.25, 0}));
}

TEUCHOS_UNIT_TEST(dense_inverse, small_diagonals_do_not_harm) {
  smoothers::DenseScratch scratch;
  const Dense a{1e-20, 1.0, 1.0, 1.0};
  Dense inverse(a);
  TEST_ASSERT(smoothers::invert_dense(2, inverse.data(), scratch));
  TEST_COMPARE(distance_from_identity(2, a, inverse), <, 1e-15);
}

TEUCHOS_UNIT_TEST(dense_inverse, what_has_none_is_refused) {
  smoothers::DenseScratch scratch;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinite = std::numeric_limits<double>::infinity();
  for (const Dense& a : {Dense{0, 0, 0, 0}, Dense{1, 2, 2, 4}, Dense{0, 0, 0, 1}, Dense{0, 1, 0, 1},
                         Dense{nan, 0, 0, 1}, Dense{1, 0, 0, nan}, Dense{infinite, 0, 0, 1}}) {
    Dense copy(a);
    TEST_ASSERT(!smoothers::invert_dense(2, copy.data(), scratch));
  }
}

}  // namespace
