#pragma once
#include "tunica/linear/setup_failure.hpp"
#include "tunica/smoothers/direct/sparse_lu.hpp"

namespace tunica::linear {

/// Sparse LU factors of a matrix as an operator. For small
/// systems. The graph must not change after construction.
class DirectFactor : public Operator {
public:
  explicit DirectFactor(const Teuchos::RCP<const CrsMatrix>& matrix);
  ~DirectFactor() override;

  /// Factors the present values. Throws SetupFailure where the matrix is singular.
  void refresh();

  /// Estimated bytes of the factors, before they are made. Collective.
  double expected_bytes() const { return factors_->expected_bytes(); }

  /// Y = alpha K⁻¹ X + beta Y.
  void apply(const MultiVector& X, MultiVector& Y, Teuchos::ETransp mode = Teuchos::NO_TRANS,
             Scalar alpha = 1.0, Scalar beta = 0.0) const override;
  Teuchos::RCP<const Map> getDomainMap() const override;
  Teuchos::RCP<const Map> getRangeMap() const override;

private:
  Teuchos::RCP<const CrsMatrix> matrix_;
  std::unique_ptr<smoothers::SparseLu> factors_;
};

/// Solves a small nonsymmetric system on all ranks and throws std::runtime_error if the answer
/// is wrong: an executable without the KLU2 repair must not run. Collective.
void check_direct_solver(const CommPtr& comm);

}  // namespace tunica::linear
