#pragma once
#include "tunica/multigrid/coarsening/mixed_coarsening.hpp"
#include "tunica/multigrid/muelu/smoothers/matrix_smoother.hpp"

namespace tunica::multigrid {

/// A smoother for mixed matrices.
class MixedSmoother : public MatrixSmoother {
public:
  /// Says how unknowns are numbered; before Setup().
  void set_coarsening(const Teuchos::RCP<MixedCoarsening>& coarsening) { coarsening_ = coarsening; }

protected:
  /// Hosts of the matrix, see MixedCoarsening.
  const Teuchos::RCP<const ::tunica::Vector>& hosts() const { return hosts_; }
  const MixedCoarsening& coarsening() const { return *coarsening_; }
  ::tunica::Vector parts(const ::tunica::CrsMatrix& K) const {
    return coarsening_->parts(level_, K);
  }
  virtual void set_up(const ::tunica::CrsMatrix& K, const algebra::DofLayout& numbering) = 0;

private:
  void set_up(int level, const Teuchos::RCP<::tunica::CrsMatrix>& K) final {
    coarsening_->check_mixed(level, *K);
    hosts_ = coarsening_->hosts(level, *K);
    level_ = level;
    set_up(*K, coarsening_->numbering());
  }

  Teuchos::RCP<MixedCoarsening> coarsening_;
  Teuchos::RCP<const ::tunica::Vector> hosts_;
  int level_ = 0;
};

}  // namespace tunica::multigrid
