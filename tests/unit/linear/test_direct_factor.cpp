#include <Teuchos_UnitTestHarness.hpp>

#include "tunica/base/trilinos.hpp"
#include "tunica/linear/direct/direct_factor.hpp"
#include "unit/fields/small_tube.hpp"

namespace {

using namespace tunica;

TEUCHOS_UNIT_TEST(direct_factor, this_executable_carries_the_klu2_repair) {
  TEST_NOTHROW(linear::check_direct_solver(test::world()));
}

/// Tridiagonal with 4 on the diagonal times a factor, three rows per rank.
Teuchos::RCP<CrsMatrix> tridiagonal(double factor) {
  const GlobalOrdinal n = 3 * test::world()->getSize();
  const Teuchos::RCP<const Map> map = Teuchos::rcp(new Map(n, 0, test::world()));
  const auto A = Teuchos::rcp(new CrsMatrix(map, 3));
  for (const GlobalOrdinal row : global_numbers(*map))
    for (const GlobalOrdinal column : {row - 1, row, row + 1})
      if (column >= 0 && column < n)
        A->insertGlobalValues(row, Teuchos::tuple<GlobalOrdinal>(column),
                              Teuchos::tuple(factor * (column == row ? 4.0 : column - row)));
  A->fillComplete();
  return A;
}

TEUCHOS_UNIT_TEST(direct_factor, apply_is_alpha_inverse_x_plus_beta_y) {
  const auto A = tridiagonal(1.0);
  linear::DirectFactor factor(A);
  factor.refresh();
  MultiVector x(A->getDomainMap(), 2), b(A->getRangeMap(), 2), y(A->getDomainMap(), 2);
  x.randomize();
  A->apply(x, b);
  y.putScalar(3.0);
  factor.apply(b, y, Teuchos::NO_TRANS, 2.0, 0.5);  // 2 x + 1.5
  y.update(-2.0, x, 1.0);
  for (int column = 0; column < 2; ++column)
    for (const double value : y.getVector(column)->getData())
      TEST_FLOATING_EQUALITY(value, 1.5, 1e-12);
}

TEUCHOS_UNIT_TEST(direct_factor, new_values_count_after_refresh_only) {
  const auto A = tridiagonal(1.0);
  linear::DirectFactor factor(A);
  factor.refresh();
  const auto map = A->getDomainMap();
  Vector b(map), old(map), kept(map), fresh(map);
  b.putScalar(1.0);
  factor.apply(b, old);
  A->resumeFill();
  A->scale(2.0);
  A->fillComplete();
  factor.apply(b, kept);
  factor.refresh();
  factor.apply(b, fresh);
  kept.update(-1.0, old, 1.0);
  fresh.update(-0.5, old, 1.0);
  TEST_COMPARE(kept.normInf(), <, 1e-15);
  TEST_COMPARE(fresh.normInf(), <, 1e-15);
}

}  // namespace
