#pragma once
#include <vector>

#include "tunica/algebra/low_rank.hpp"

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
    int block;                                   ///< in the whole
    Teuchos::RCP<const Map> owned, with_ghosts;  ///< the part's unknowns
    std::vector<GlobalOrdinal> numbers;          ///< in the whole, of those with ghosts
  };
  /// A place per block of the part. Collective.
  Embedding(const BlockSpace& whole, std::vector<Place> places);

  /// S and R, per block of the part; all 1 at first.
  void set_units(std::vector<double> unknowns, std::vector<double> equations);
  double unit_of_unknowns(int block) const { return unknowns_[block]; }
  double unit_of_equations(int block) const { return equations_[block]; }

  /// x_part ← S P x.
  void restrict(const BlockVector& x, BlockVector& part) const;
  /// x ← Pᵀ S⁻¹ x_part where the part has unknowns; others stay.
  void insert(const BlockVector& part, BlockVector& x) const;
  /// F ← F + R Pᵀ F_part.
  void add(const BlockVector& part, BlockVector& F) const;
  /// The products of a part become those of the whole from `first` on.
  void set_products(const LowRank& part, LowRank& whole, int first) const;
  /// K ← K + R Pᵀ K_part P S for one block, which has entries where the part has some.
  void add_block(const CrsMatrix& part, int row, int column, CrsMatrix& whole) const;

private:
  /// x ← x + W Pᵀ x_part, W numbers per block.
  void add_weighted(const std::vector<double>& weights, const BlockVector& part,
                    BlockVector& x) const;

  std::vector<Place> places_;
  std::vector<std::vector<int>> rows_;  ///< local rows in the whole, per block of the part
  std::vector<double> unknowns_, equations_;
};

}  // namespace tunica::algebra
