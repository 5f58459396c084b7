#pragma once
#include <vector>

#include "tunica/algebra/block_space.hpp"

namespace tunica::algebra {

/// Numbers of the unknowns of a merged matrix, in which those of a node stand side by side, block
/// by block: dofs*node + k. In its block an unknown has the number components*node + i. Not every
/// number need be there: a node may lack unknowns.
///
/// Layout of a saddle-point system: the first block holds the vector unknowns, all others are
/// scalars that constrain it (pressures).
class DofLayout {
public:
  /// Three components of a vector and one scalar.
  DofLayout() : DofLayout(std::vector<int>{3, 1}) {}
  /// Unknowns per node of each block.
  explicit DofLayout(std::vector<int> components);
  explicit DofLayout(const BlockSpace& space);

  int n_blocks() const { return static_cast<int>(components_.size()); }
  int components(int block) const { return components_[block]; }
  int dofs() const { return static_cast<int>(block_of_.size()); }

  int block_of(GlobalOrdinal number) const { return block_of_[number % dofs()]; }
  bool is_scalar(GlobalOrdinal number) const { return block_of(number) > 0; }
  /// From a number of the merged matrix to that in its block, and back.
  GlobalOrdinal in_block(GlobalOrdinal number) const {
    const int b = block_of(number);
    return number / dofs() * components_[b] + number % dofs() - first_[b];
  }
  GlobalOrdinal merged(int block, GlobalOrdinal in_block) const {
    const int m = components_[block];
    return in_block / m * dofs() + first_[block] + in_block % m;
  }

  /// The unknowns of all blocks, ascending on each rank. Collective.
  Teuchos::RCP<const Map> merged_map(const BlockSpace& space) const;
  /// The unknowns of one block in those of all. Collective.
  Teuchos::RCP<const Map> block_map(const Map& merged, int block) const;
  /// The merged numbers of those that a block's map has, in its order.
  std::vector<GlobalOrdinal> merged_numbers(const Map& in_block, int block) const;

private:
  std::vector<int> components_;
  std::vector<int> first_;     ///< of each block's unknowns at a node
  std::vector<int> block_of_;  ///< of each unknown at a node
};

}  // namespace tunica::algebra
