#include <Teuchos_UnitTestHarness.hpp>
#include <algorithm>
#include <stdexcept>
#include <vector>

#include "tunica/base/session.hpp"
#include "tunica/base/trilinos.hpp"
#include "tunica/smoothers/direct/sparse_lu.hpp"

namespace {

using namespace tunica;
using smoothers::SparseLu;

constexpr int n = 13;

/// 1, 4, 7, …: with gaps, and dealt to the ranks in turn.
Teuchos::RCP<const Map> dealt_rows() {
  const CommPtr comm = all_ranks();
  std::vector<GlobalOrdinal> mine;
  for (int k = comm->getRank(); k < n; k += comm->getSize()) mine.push_back(3 * k + 1);
  return Teuchos::rcp(new Map(n, Teuchos::arrayViewFromVector(mine), 0, comm));
}

/// Of rows k: 4 x_k − 2 x_{k−1} − x_{k+1}.
Teuchos::RCP<CrsMatrix> nonsymmetric(const Teuchos::RCP<const Map>& rows) {
  const auto A = Teuchos::rcp(new CrsMatrix(rows, 3));
  for (const GlobalOrdinal row : global_numbers(*rows)) {
    const auto put = [&](GlobalOrdinal column, double value) {
      if (column >= 1 && column <= 3 * (n - 1) + 1)
        A->insertGlobalValues(row, Teuchos::tuple(column), Teuchos::tuple(value));
    };
    put(row, 4.0);
    put(row - 3, -2.0);
    put(row + 3, -1.0);
  }
  A->fillComplete();
  return A;
}

double error_of(const SparseLu& lu, const CrsMatrix& A, std::size_t columns) {
  MultiVector x(A.getRowMap(), columns), b(A.getRowMap(), columns), found(A.getRowMap(), columns);
  x.randomize();
  A.apply(x, b);
  found.putScalar(7.0);  // must not matter
  lu.solve(b, found);
  found.update(-1.0, x, 1.0);
  Teuchos::Array<double> norms(columns);
  found.normInf(norms());
  return *std::max_element(norms.begin(), norms.end());
}

TEUCHOS_UNIT_TEST(sparse_lu, solves_where_numbers_have_gaps_and_any_number_of_columns) {
  const auto A = nonsymmetric(dealt_rows());
  SparseLu lu(A);
  lu.refactor();
  for (const std::size_t columns : {1, 3, 2}) TEST_COMPARE(error_of(lu, *A, columns), <, 1e-13);
}

TEUCHOS_UNIT_TEST(sparse_lu, follows_new_values) {
  const auto A = nonsymmetric(dealt_rows());
  SparseLu lu(A);
  lu.refactor();
  Vector scale(A->getRowMap());
  scale.randomize(1.5, 3.0);
  A->leftScale(scale);
  TEST_COMPARE(error_of(lu, *A, 1), >, 1e-3);
  lu.refactor();
  TEST_COMPARE(error_of(lu, *A, 1), <, 1e-12);
}

TEUCHOS_UNIT_TEST(sparse_lu, all_ranks_hear_of_a_singular_matrix) {
  const auto A = nonsymmetric(dealt_rows());
  SparseLu lu(A);
  A->resumeFill();
  A->setAllToScalar(0.0);
  A->fillComplete();
  TEST_THROW(lu.refactor(), std::runtime_error);
}

}  // namespace
