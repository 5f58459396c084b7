#pragma once
#include "tunica/algebra/block_matrices.hpp"

namespace tunica::algebra {

/// Both blocks of a field behind each other in one vector: on each rank its vector unknowns,
/// then its scalar ones. The blocks are views, so that Krylov methods on the long vectors work
/// on the blocks without copies.
class Concatenation {
public:
  Concatenation(const Teuchos::RCP<const Map>& vectors, const Teuchos::RCP<const Map>& scalars);

  Teuchos::RCP<const Map> map() const { return map_; }
  Teuchos::RCP<MultiVector> vector_part(const MultiVector& x) const;
  Teuchos::RCP<MultiVector> scalar_part(const MultiVector& x) const;

private:
  Teuchos::RCP<const Map> map_, vector_map_, scalar_map_;
};

/// K on concatenated vectors.
class ConcatenatedOperator : public Operator {
public:
  ConcatenatedOperator(const Concatenation& blocks, const BlockMatrices& K)
      : blocks_(blocks), K_(&K) {}

  void apply(const MultiVector& X, MultiVector& Y, Teuchos::ETransp mode = Teuchos::NO_TRANS,
             Scalar alpha = 1.0, Scalar beta = 0.0) const override;
  Teuchos::RCP<const Map> getDomainMap() const override { return blocks_.map(); }
  Teuchos::RCP<const Map> getRangeMap() const override { return blocks_.map(); }

private:
  Concatenation blocks_;
  const BlockMatrices* K_;
};

}  // namespace tunica::algebra
