#pragma once
#include <vector>

#include "tunica/algebra/block_matrix.hpp"

namespace tunica::algebra {

/// A part of a larger system, whose unknowns are some of those of the whole in other units, shared
/// with other parts where they have the same:
///
///   x_part = S P x        F ← F + R Pᵀ F_part        K ← K + R Pᵀ K_part P S
///
///   P   picks from the unknowns of the whole      S   units of the unknowns
///                                                 R   weights of the equations
///
/// S and R are numbers per block. Owned unknowns of the part belong to the same rank in the whole.
class Embedding {
public:
  /// Where a block of the part stands.
  struct Place {
    int block;  ///< in the whole
    /// There, of the block's unknowns of this rank and, behind them, of its ghosts in the order of
    /// the column maps.
    std::vector<GlobalOrdinal> numbers;
  };
  /// A place per block of the part. Both matrices outlive the object; those of the part have
  /// entries where those of the whole have some. Collective.
  Embedding(const BlockMatrix& part, const BlockMatrix& whole, std::vector<Place> places);

  /// S and R, per block of the part; all 1 at first.
  void set_units(std::vector<double> unknowns, std::vector<double> equations);

  /// x_part ← S P x.
  void restrict(const BlockVector& x, BlockVector& part) const;
  /// x ← Pᵀ S⁻¹ x_part where the part has unknowns; others stay.
  void insert(const BlockVector& part, BlockVector& x) const;
  /// F ← F + R Pᵀ F_part.
  void add(const BlockVector& part, BlockVector& F) const;
  /// values ← values + R Pᵀ K_part P S, for the blocks of the whole as they are stored. The
  /// products of low rank become those from `first_product` on.
  void add_matrix(BlockMatrix& whole, int first_product) const;
  /// The same for one matrix with the entries of that block of the part.
  void add_block(const CrsMatrix& part, int row, int column, CrsMatrix& whole) const;

private:
  /// A block of the part, and where each of its values stands in that of the whole.
  struct MatrixPlace {
    int row, column;
    std::vector<int> offsets;
  };

  /// x ← x + W Pᵀ x_part, W numbers per block.
  void add_weighted(const std::vector<double>& weights, const BlockVector& part,
                    BlockVector& x) const;

  const BlockMatrix* part_;
  std::vector<int> blocks_;             ///< of the whole, per block of the part
  std::vector<std::vector<int>> rows_;  ///< local rows there, per block
  std::vector<MatrixPlace> matrices_;
  std::vector<double> unknowns_, equations_;
};

}  // namespace tunica::algebra
