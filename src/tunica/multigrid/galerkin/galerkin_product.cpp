#include "tunica/multigrid/galerkin/galerkin_product.hpp"

#include <vector>

namespace tunica::multigrid {

namespace {

/// R = Pᵀ, entry by entry. Both on one rank.
bool is_transpose(const CrsMatrix& R, const CrsMatrix& P) {
  const auto rows = R.getLocalMatrixHost(), columns = P.getLocalMatrixHost();
  if (rows.nnz() != columns.nnz() || rows.numRows() != columns.numCols()) return false;
  std::vector<int> next(rows.numRows(), 0);  // entries of each row of R that have been met
  for (int i = 0; i < columns.numRows(); ++i) {
    const auto of_P = columns.rowConst(i);
    for (int k = 0; k < of_P.length; ++k) {
      const auto of_R = rows.rowConst(of_P.colidx(k));
      const int n = next[of_P.colidx(k)]++;
      if (n >= of_R.length || of_R.colidx(n) != i || of_R.value(n) != of_P.value(k)) return false;
    }
  }
  return true;
}

}  // namespace

GalerkinProduct::GalerkinProduct(const Teuchos::RCP<const CrsMatrix>& R,
                                 const Teuchos::RCP<const CrsMatrix>& A,
                                 const Teuchos::RCP<const CrsMatrix>& P,
                                 const algebra::DofLayout& numbering, double stabilisation_factor)
    : R_(R), A_(A), P_(P), numbering_(numbering), stabilisation_factor_(stabilisation_factor) {
  // Pᵀ A P in one go saves the storage of A P.
  if (algebra::TripleProduct::serves(*A, *P) && is_transpose(*R, *P)) {
    triple_.emplace(*A, *P);
  } else {
    AP_.emplace(*A, *P);
    RAP_.emplace(*R, *AP_->matrix());
  }
  refresh();
}

// R A P, on one rank with R = Pᵀ without the product between
void GalerkinProduct::refresh() {
  if (triple_) {
    triple_->refresh();
  } else {
    AP_->refresh();
    RAP_->refresh();
  }
  if (stabilisation_factor_ != 1.0) scale_stabilisation();
}

// −C ← −σ C, the block of the scalars
void GalerkinProduct::scale_stabilisation() {
  CrsMatrix& K = *matrix();
  const auto domain = K.getDomainMap(), range = K.getRangeMap();
  K.resumeFill();
  {
    const auto local = K.getLocalMatrixHost();
    for (int i = 0; i < local.numRows(); ++i) {
      if (!numbering_.is_scalar(K.getRowMap()->getGlobalElement(i))) continue;
      auto row = local.row(i);
      for (int k = 0; k < row.length; ++k)
        if (numbering_.is_scalar(K.getColMap()->getGlobalElement(row.colidx(k))))
          row.value(k) *= stabilisation_factor_;
    }
  }
  K.fillComplete(domain, range);
}

}  // namespace tunica::multigrid
