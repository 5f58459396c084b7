#pragma once
#include <map>
#include <memory>

#include "tunica/algebra/block_matrices.hpp"
#include "tunica/algebra/dof_layout.hpp"
#include "tunica/multigrid/coarsening/nodal_coarsening.hpp"

namespace tunica::multigrid {

/// Coarser and coarser levels for a block system, its blocks, and the mixed matrix with both
/// (DofLayout). Where vector and scalar unknowns have the same nodes, they keep them on each
/// level: one scalar beside its vector components. Depends on graphs alone, and is made level by
/// level as asked for.
class MixedCoarsening {
public:
  explicit MixedCoarsening(const algebra::BlockMatrices& K);

  const algebra::DofLayout& numbering() const { return numbering_; }

  /// Interpolation from level + 1 to level (0 the finest) for the block, or the mixed matrix, that
  /// has these rows on this level. Its rows sum to one, but for unknowns none of whose coarse
  /// nodes has their component: those are left to the smoother. Throws std::runtime_error where
  /// none has as many. Collective where it is asked for the first time.
  Teuchos::RCP<const CrsMatrix> prolongator(int level, const Map& rows);

  /// Throws std::runtime_error on all ranks where K on this level is one block, or its rows are not
  /// unknowns of a mixed matrix. Collective.
  void check_mixed(int level, const CrsMatrix& K);

private:
  enum class Part { vector, scalar, both };

  Part part_of(int level, const Map& rows);
  const Teuchos::RCP<const Map>& map(int level, Part part);
  Teuchos::RCP<const CrsMatrix> prolongator(int level, Part part);

  algebra::DofLayout numbering_;
  std::shared_ptr<NodalCoarsening> vectors_, scalars_;
  std::map<std::pair<int, Part>, Teuchos::RCP<const Map>> maps_;
  std::map<std::pair<int, Part>, Teuchos::RCP<const CrsMatrix>> prolongators_;
};

}  // namespace tunica::multigrid
