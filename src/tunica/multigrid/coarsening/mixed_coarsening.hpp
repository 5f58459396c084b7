#pragma once
#include <map>
#include <memory>
#include <string>
#include <tuple>
#include <vector>

#include "tunica/algebra/dof_layout.hpp"
#include "tunica/multigrid/coarsening/nodal_coarsening.hpp"

namespace tunica::multigrid {

/// Coarser and coarser levels for the blocks of a space, and for the merged matrix of all
/// (DofLayout). Blocks on the same nodes keep them on each level: one pressure beside the
/// components of its velocity. Those whose nodes have hosts follow the first block. Depends on
/// graphs alone, and is made level by level as asked for.
class MixedCoarsening {
public:
  /// Every block names its nodes.
  explicit MixedCoarsening(const algebra::BlockSpace& space);

  const algebra::DofLayout& numbering() const { return numbering_; }

  /// Interpolation from level + 1 to level (0 the finest) for the block, or the mixed matrix, that
  /// has these rows on this level. Its rows sum to one, but for unknowns none of whose coarse
  /// nodes has their component: those are left to the smoother. Throws std::runtime_error where
  /// none has as many. Collective where it is asked for the first time.
  /// has_rotations: displacements of solids are interpolated so that rigid motions are exact
  /// (RigidInterpolation), where places of the nodes are known.
  Teuchos::RCP<const CrsMatrix> prolongator(int level, const Map& rows, bool has_rotations = false);

  /// By node of scalars of K, the mixed matrix on this level: the number of the node whose vector
  /// stands in the same place, -1 for none. Null where all blocks stand on the same nodes, or
  /// another coarsening made the level. Collective.
  Teuchos::RCP<const Vector> hosts(int level, const CrsMatrix& K);

  /// flatness_of_solids of the finest level.
  double flatness() const { return nodes_.front()->flatness(); }

  /// Names of the parts that the nodes of the finest level stand in; none for one field.
  const std::vector<std::string>& part_names() const { return part_names_; }
  /// By row of K, the mixed matrix on this level, which of them its node stands in. Throws
  /// std::runtime_error where another coarsening made the level. Collective.
  Vector parts(int level, const CrsMatrix& K);

  /// Throws std::runtime_error on all ranks where K on this level is one block, or its rows are not
  /// unknowns of a mixed matrix. Collective.
  void check_mixed(int level, const CrsMatrix& K);

private:
  static constexpr int all = -1;  ///< in the place of a block: the merged matrix

  int block_of(int level, const Map& rows);
  const Teuchos::RCP<const Map>& map(int level, int block);
  Teuchos::RCP<const CrsMatrix> prolongator(int level, int block, bool has_rotations = false);

  algebra::DofLayout numbering_;
  std::vector<std::string> part_names_;
  std::vector<std::vector<Teuchos::RCP<const Vector>>> parts_;   ///< by level and block
  std::vector<std::shared_ptr<NodalCoarsening>> nodes_;          ///< per block
  std::map<std::pair<int, int>, Teuchos::RCP<const Map>> maps_;  ///< by level and block
  std::map<std::tuple<int, int, bool>, Teuchos::RCP<const CrsMatrix>> prolongators_;
};

}  // namespace tunica::multigrid
