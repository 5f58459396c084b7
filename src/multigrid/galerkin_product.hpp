#pragma once
#include "multigrid/mixed_numbering.hpp"
#include "multigrid/refreshable.hpp"
#include "multigrid/sparse_product.hpp"

namespace tunica::multigrid {

/// R A P, and again for new values of A on the same graphs. Optionally the stabilisation block C of
/// a mixed matrix is multiplied by a factor.
class GalerkinProduct : public Refreshable {
public:
  /// The matrices must not change but for the values of A. Collective.
  GalerkinProduct(const Teuchos::RCP<const CrsMatrix>& R, const Teuchos::RCP<const CrsMatrix>& A,
                  const Teuchos::RCP<const CrsMatrix>& P, const MixedNumbering& numbering,
                  double stabilisation_factor);

  Teuchos::RCP<CrsMatrix> matrix() const { return RAP_.matrix(); }
  void refresh() override;

private:
  void scale_stabilisation();

  Teuchos::RCP<const CrsMatrix> R_, A_, P_;
  MixedNumbering numbering_;
  double stabilisation_factor_;
  SparseProduct AP_, RAP_;
};

}  // namespace tunica::multigrid
