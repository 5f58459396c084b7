#pragma once
#include "tunica/linear/direct/multifrontal_lu.hpp"
#include "tunica/linear/setup_failure.hpp"

namespace tunica::linear {

/// Sparse LU factors of a matrix as an operator. The graph must not change after construction.
class DirectFactor : public Operator {
public:
  /// most_operations: of the factors, per entry of the matrix; 0: any number. Throws SetupFailure
  /// where they would take more. Multigrid takes as long as some 3,000 for a solution, of any
  /// matrix: factors of n unknowns in the plane take less up to n of some 10⁵, in space up to some
  /// 10³. Collective.
  explicit DirectFactor(const Teuchos::RCP<const CrsMatrix>& matrix, double most_operations = 0.0);
  ~DirectFactor() override;

  /// Factors the present values. Throws SetupFailure where the matrix is singular.
  void refresh();

  /// Estimated bytes of the factors, before they are made. Collective.
  double expected_bytes() const;

  /// Y = alpha K⁻¹ X + beta Y.
  void apply(const MultiVector& X, MultiVector& Y, Teuchos::ETransp mode = Teuchos::NO_TRANS,
             Scalar alpha = 1.0, Scalar beta = 0.0) const override;
  Teuchos::RCP<const Map> getDomainMap() const override;
  Teuchos::RCP<const Map> getRangeMap() const override;

private:
  void set_order(double most_operations);

  Teuchos::RCP<const CrsMatrix> matrix_;
  std::unique_ptr<smoothers::SparseLu> factors_;
};

/// Floating-point operations that sparse LU factors take of a matrix with this graph; where they
/// are more than enough, a lower bound may take their place. Collective.
double factor_operations(const Teuchos::RCP<const CrsGraph>& graph, double enough);

/// Solves a small nonsymmetric system on all ranks and throws std::runtime_error if the answer
/// is wrong: an executable without the KLU2 repair must not run. Collective.
void check_direct_solver(const CommPtr& comm);

}  // namespace tunica::linear
