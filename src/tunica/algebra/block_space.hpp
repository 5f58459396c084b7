#pragma once
#include <memory>
#include <string>
#include <vector>

#include "tunica/base/types.hpp"

namespace tunica::algebra {

/// Positions of the nodes, for coarse levels that interpolate the rotations of solids. Both null if
/// unknown.
struct NodePlaces {
  Teuchos::RCP<const MultiVector> coordinates;  ///< three columns [mm]
  Teuchos::RCP<const Vector> in_solid;          ///< 1 where vectors move a solid, 0 elsewhere
};

/// Nodes as multigrid sees them.
struct Nodes {
  Teuchos::RCP<const CrsGraph> graph;  ///< a row per node, its neighbours and itself
  Teuchos::RCP<const Vector> order;    ///< in which nodes are picked; the same on any ranks
  /// Hosts of nodes that coincide with nodes of the first block: the number of that node. Null if
  /// the nodes are the same, or unrelated.
  Teuchos::RCP<const Vector> hosts{};
  /// Part of each node, of the parts that the space names. Null if it names none.
  Teuchos::RCP<const Vector> parts{};
  NodePlaces places{};
};

/// Unknowns of one kind: velocities, pressures.
struct Block {
  std::string name;
  /// Unknown i of a node has the number components*node + i. A node may lack some.
  Teuchos::RCP<const Map> map;
  int components = 1;  ///< unknowns per node
  Nodes nodes{};       ///< the same graph where blocks share their nodes; may be left out where
                       ///< nothing coarsens
};

/// The blocks that unknowns, residuals and Jacobians of a problem are made of, in this order.
class BlockSpace {
public:
  /// At least one block; names differ. parts: names of what the nodes of a coupled system stand in;
  /// the last is that between the others, which multigrid picks first: "wall", "lumen",
  /// "interface".
  explicit BlockSpace(std::vector<Block> blocks, std::vector<std::string> parts = {});

  int n_blocks() const { return static_cast<int>(blocks_.size()); }
  const Block& operator[](int b) const { return blocks_[b]; }
  /// Throws std::invalid_argument that lists the names for an unknown one.
  int index_of(const std::string& name) const;
  const std::vector<std::string>& parts() const { return parts_; }

  CommPtr comm() const { return blocks_.front().map->getComm(); }
  long long n_unknowns() const;  ///< of all ranks

private:
  std::vector<Block> blocks_;
  std::vector<std::string> parts_;
};

using BlockSpacePtr = std::shared_ptr<const BlockSpace>;

}  // namespace tunica::algebra
