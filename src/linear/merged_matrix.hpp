#pragma once
#include "fields/block_operator.hpp"

namespace tunica::linear {

/// A block operator as one matrix with the unknowns of a node side by side, 4*node + i for
/// the vector and 4*node + 3 for the scalar: what incomplete and complete factorisations of
/// the whole system work on. A copy of the values; refresh() takes them over.
class MergedMatrix {
public:
  explicit MergedMatrix(const fields::BlockOperator& K);

  void refresh();
  Teuchos::RCP<CrsMatrix> matrix() const { return matrix_; }

  void merge(const fields::BlockVector& x, MultiVector& merged) const;
  void split(const MultiVector& merged, fields::BlockVector& x) const;

private:
  const fields::BlockOperator* K_;
  Teuchos::RCP<CrsMatrix> matrix_;
};

}  // namespace tunica::linear
