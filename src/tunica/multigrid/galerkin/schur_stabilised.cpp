#include "tunica/multigrid/galerkin/schur_stabilised.hpp"

#include <TpetraExt_MatrixMatrix.hpp>
#include <algorithm>

#include "tunica/algebra/entry_offsets.hpp"
#include "tunica/algebra/static_matrix.hpp"
#include "tunica/base/trilinos.hpp"

namespace tunica::multigrid {

namespace {

/// Rows of scalars with columns of vectors, or the other way round, without values.
Teuchos::RCP<CrsMatrix> coupling(const CrsMatrix& K, const algebra::DofLayout& numbering,
                                 bool has_scalar_rows) {
  const auto local = K.getLocalMatrixHost();
  std::vector<char> is_wanted;
  for (int j = 0; j < local.numCols(); ++j)
    is_wanted.push_back(numbering.is_scalar(K.getColMap()->getGlobalElement(j)) != has_scalar_rows);
  algebra::RowStart row_start("row start", local.numRows() + 1);
  std::vector<int> all;
  for (int i = 0; i < local.numRows(); ++i) {
    const auto row = local.rowConst(i);
    if (numbering.is_scalar(K.getRowMap()->getGlobalElement(i)) == has_scalar_rows)
      for (int k = 0; k < row.length; ++k)
        if (is_wanted[row.colidx(k)]) all.push_back(row.colidx(k));
    row_start(i + 1) = all.size();
  }
  algebra::LocalColumns columns("columns", all.size());
  std::copy(all.begin(), all.end(), columns.data());
  return algebra::matrix_on(
      algebra::static_graph(K.getRowMap(), K.getColMap(), row_start, columns, K.getDomainMap()));
}

void add(double factor, const CrsMatrix& part, const std::vector<int>& places, CrsMatrix& whole) {
  const auto from = part.getLocalMatrixHost().values;
  const auto to = whole.getLocalMatrixHost().values;
  for (std::size_t k = 0; k < places.size(); ++k) to(places[k]) += factor * from(k);
}

/// Values of K, row by row times a factor.
void take(const CrsMatrix& K, const std::vector<int>& places, const Vector& factors,
          CrsMatrix& part) {
  part.resumeFill();
  {
    const auto from = K.getLocalMatrixHost().values;
    const auto to = part.getLocalMatrixHost();
    const auto factor = factors.getLocalViewHost(read_only);
    for (int i = 0; i < to.numRows(); ++i)
      for (auto k = to.graph.row_map(i); k < to.graph.row_map(i + 1); ++k)
        to.values(k) = factor(i, 0) * from(places[k]);
  }
  part.fillComplete(K.getDomainMap(), K.getRangeMap());
}

}  // namespace

SchurStabilised::SchurStabilised(const Teuchos::RCP<const CrsMatrix>& K,
                                 const algebra::DofLayout& numbering, double factor)
    : K_(K), factor_(factor), B2_(coupling(*K, numbering, true)),
      B1T_(coupling(*K, numbering, false)), product_(*B2_, *B1T_),
      sum_(Tpetra::MatrixMatrix::add(1.0, false, *product_.matrix(), 1.0, false, *K,
                                     K->getDomainMap(), K->getRangeMap())),
      from_B2_(algebra::entry_offsets(*B2_, *K)), from_B1T_(algebra::entry_offsets(*B1T_, *K)),
      product_in_sum_(algebra::entry_offsets(*product_.matrix(), *sum_)),
      K_in_sum_(algebra::entry_offsets(*K, *sum_)) {
  refresh();
}

void SchurStabilised::refresh() {
  Vector inverse(K_->getRowMap()), ones(K_->getRowMap());
  ones.putScalar(1.0);
  K_->getLocalDiagCopy(inverse);
  {
    const auto d = inverse.getLocalViewHost(read_write);
    for (std::size_t i = 0; i < d.extent(0); ++i) d(i, 0) = d(i, 0) != 0.0 ? 1.0 / d(i, 0) : 0.0;
  }
  take(*K_, from_B2_, ones, *B2_);
  take(*K_, from_B1T_, inverse, *B1T_);  // diag(A)⁻¹ B1ᵀ
  product_.refresh();
  // K − σ B2 (diag(A)⁻¹ B1ᵀ)
  sum_->resumeFill();
  sum_->setAllToScalar(0.0);
  add(1.0, *K_, K_in_sum_, *sum_);
  add(-factor_, *product_.matrix(), product_in_sum_, *sum_);
  sum_->fillComplete(K_->getDomainMap(), K_->getRangeMap());
}

}  // namespace tunica::multigrid
