#pragma once
#include <memory>
#include <optional>

#include "tunica/algebra/dof_layout.hpp"
#include "tunica/algebra/products/sparse_product.hpp"
#include "tunica/algebra/products/triple_product.hpp"
#include "tunica/algebra/refreshable.hpp"
#include "tunica/multigrid/galerkin/schur_stabilised.hpp"

namespace tunica::multigrid {

/// Of the block C of a mixed matrix on each coarser level.
struct Stabilisation {
  double factor = 1.0;  ///< of C
  double schur = 0.0;   ///< σ of SchurStabilised
  double least = 0.0;   ///< σ of enlarge_stabilisation()
};

/// R A P, and again for new values of A on the same graphs; of a mixed matrix with more of a
/// stabilisation if asked for.
class GalerkinProduct : public algebra::Refreshable {
public:
  /// The matrices must not change but for the values of A. R: Pᵀ where it is null. Collective.
  GalerkinProduct(const Teuchos::RCP<const CrsMatrix>& R, const Teuchos::RCP<const CrsMatrix>& A,
                  const Teuchos::RCP<const CrsMatrix>& P, const algebra::DofLayout& numbering,
                  const Stabilisation& stabilisation);

  Teuchos::RCP<CrsMatrix> matrix() const { return triple_ ? triple_->matrix() : RAP_->matrix(); }
  void refresh() override;

private:
  void take_values();
  void scale_stabilisation();

  Teuchos::RCP<const CrsMatrix> R_, P_;
  std::unique_ptr<SchurStabilised> stabilised_;  ///< null: A as it is
  Teuchos::RCP<const CrsMatrix> A_;
  algebra::DofLayout numbering_;
  Stabilisation stabilisation_;
  std::optional<algebra::TripleProduct> triple_;    ///< where R = Pᵀ
  std::optional<algebra::SparseProduct> AP_, RAP_;  ///< elsewhere
};

}  // namespace tunica::multigrid
