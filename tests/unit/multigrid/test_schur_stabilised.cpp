#include <Teuchos_UnitTestHarness.hpp>
#include <Tpetra_Core.hpp>
#include <map>

#include "tunica/base/trilinos.hpp"
#include "tunica/multigrid/galerkin/schur_stabilised.hpp"

namespace {

using namespace tunica;

constexpr GlobalOrdinal n = 9;  // nodes of a ring, with a vector of one component and a scalar
constexpr double sigma = 0.25;

double a(GlobalOrdinal node) { return 2.0 + static_cast<double>(node % n); }

/// Of node i: a_i u_i − u_{i+1} + 2 (p_i − p_{i−1}) and u_i − u_{i+1} − p_i / 8, times a factor.
Teuchos::RCP<CrsMatrix> ring(double factor) {
  const auto map = Teuchos::rcp(new Map(2 * n, 0, Tpetra::getDefaultComm()));
  const auto K = Teuchos::rcp(new CrsMatrix(map, 4));
  for (const GlobalOrdinal row : global_numbers(*map)) {
    const GlobalOrdinal i = row / 2, next = (i + 1) % n, last = (i + n - 1) % n;
    const auto put = [&](GlobalOrdinal column, double value) {
      K->insertGlobalValues(row, Teuchos::tuple(column), Teuchos::tuple(factor * value));
    };
    put(2 * i, row % 2 == 0 ? a(i) : 1.0);
    put(2 * next, -1.0);
    put(2 * i + 1, row % 2 == 0 ? 2.0 : -0.125);
    if (row % 2 == 0) put(2 * last + 1, -2.0);
  }
  K->fillComplete();
  return K;
}

std::map<GlobalOrdinal, double> entries(const CrsMatrix& K, int row) {
  std::map<GlobalOrdinal, double> all;
  const auto local = K.getLocalMatrixHost();
  const auto part = local.rowConst(row);
  for (int k = 0; k < part.length; ++k)
    if (part.value(k) != 0.0) all[K.getColMap()->getGlobalElement(part.colidx(k))] = part.value(k);
  return all;
}

void check(const CrsMatrix& K, const CrsMatrix& more, double factor, Teuchos::FancyOStream& out,
           bool& success) {
  for (int row = 0; row < static_cast<int>(n_local_rows(K)); ++row) {
    const GlobalOrdinal number = K.getRowMap()->getGlobalElement(row);
    auto expected = entries(K, row);
    if (number % 2 == 1) {
      // (B2 diag(A)⁻¹ B1ᵀ)_ij for j = i − 1, i, i + 1
      const GlobalOrdinal i = number / 2, next = (i + 1) % n, last = (i + n - 1) % n;
      expected[2 * last + 1] -= factor * sigma * -2.0 / a(i);
      expected[2 * i + 1] -= factor * sigma * (2.0 / a(i) + 2.0 / a(next));
      expected[2 * next + 1] -= factor * sigma * -2.0 / a(next);
    }
    const auto found = entries(more, row);
    TEST_EQUALITY(found.size(), expected.size());
    for (const auto& [column, value] : expected)
      TEST_FLOATING_EQUALITY(found.at(column), value, 1e-14);
  }
}

TEUCHOS_UNIT_TEST(schur_stabilised, scalars_get_a_part_of_the_schur_complement) {
  const auto K = ring(1.0);
  multigrid::SchurStabilised more(K, algebra::DofLayout({1, 1}), sigma);
  check(*K, *more.matrix(), 1.0, out, success);
  K->resumeFill();
  K->scale(3.0);
  K->fillComplete();
  more.refresh();
  check(*K, *more.matrix(), 3.0, out, success);
}

}  // namespace
