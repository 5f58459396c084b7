#pragma once
#include <optional>

#include "tunica/algebra/dof_layout.hpp"
#include "tunica/algebra/products/sparse_product.hpp"
#include "tunica/algebra/products/triple_product.hpp"
#include "tunica/algebra/refreshable.hpp"

namespace tunica::multigrid {

/// R A P, and again for new values of A on the same graphs. Optionally the stabilisation block C of
/// a mixed matrix is multiplied by a factor.
class GalerkinProduct : public algebra::Refreshable {
public:
  /// The matrices must not change but for the values of A. Collective.
  GalerkinProduct(const Teuchos::RCP<const CrsMatrix>& R, const Teuchos::RCP<const CrsMatrix>& A,
                  const Teuchos::RCP<const CrsMatrix>& P, const algebra::DofLayout& numbering,
                  double stabilisation_factor);

  Teuchos::RCP<CrsMatrix> matrix() const { return triple_ ? triple_->matrix() : RAP_->matrix(); }
  void refresh() override;

private:
  void scale_stabilisation();

  Teuchos::RCP<const CrsMatrix> R_, A_, P_;
  algebra::DofLayout numbering_;
  double stabilisation_factor_;
  std::optional<algebra::TripleProduct> triple_;    ///< where R = Pᵀ
  std::optional<algebra::SparseProduct> AP_, RAP_;  ///< elsewhere
};

}  // namespace tunica::multigrid
