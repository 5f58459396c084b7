#pragma once
#include <vector>

#include "tunica/algebra/dof_layout.hpp"
#include "tunica/algebra/products/sparse_product.hpp"

namespace tunica::multigrid {

/// A mixed matrix K = [A B1ᵀ; B2 −C] with more of a stabilisation:
///
///   K' = [A B1ᵀ; B2 −C − σ B2 diag(A)⁻¹ B1ᵀ]
///
/// Interpolated scalars and vectors of a coarse level need not be stable with each other where C is
/// zero, though those of the fine level are: scalars p with B1ᵀ P p ≈ 0 in the coarse vectors
/// alone. Galerkin's product of K' tells of them what the fine level does.
class SchurStabilised {
public:
  /// K must keep its graph. Collective.
  SchurStabilised(const Teuchos::RCP<const CrsMatrix>& K, const algebra::DofLayout& numbering,
                  double factor);
  SchurStabilised(const SchurStabilised&) = delete;  // product_ refers to the parts
  SchurStabilised& operator=(const SchurStabilised&) = delete;

  const Teuchos::RCP<CrsMatrix>& matrix() const { return sum_; }
  /// For new values of K. Collective.
  void refresh();

private:
  Teuchos::RCP<const CrsMatrix> K_;
  double factor_;
  Teuchos::RCP<CrsMatrix> B2_,
      B1T_;  ///< with the rows and columns of K; the second divided by A_ii
  algebra::SparseProduct product_;
  Teuchos::RCP<CrsMatrix> sum_;
  std::vector<int> from_B2_, from_B1T_;         ///< places of their values in K
  std::vector<int> product_in_sum_, K_in_sum_;  ///< and of values in the sum
};

}  // namespace tunica::multigrid
