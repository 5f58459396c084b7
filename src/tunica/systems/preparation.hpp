#pragma once
#include "tunica/systems/blocks.hpp"

namespace tunica::systems {

/// An unknown that no equation determines, in Preparation::known_in.
constexpr double undetermined = -1.0;
/// One that is eliminated by a solve of its own.
constexpr double bordering = -2.0;

/// What is made of a matrix K of another program before it is solved with, and the way back.
/// right_side.hpp has b' and x_k.
///
///   R K' C y = R b',   x = x_k + C y
///
///   K'    K without entries that are rounding; rows and columns of known unknowns have only their
///         diagonal
///   b'    b − K x_k in the other rows, 0 in those
///   x_k   known values, 0 elsewhere
///   R, C  diagonal, powers of two, so that nothing is rounded: one number for each field, but for
///         rows that are much larger or smaller than those around them
///
/// C is not an equilibration of every column: multigrid interpolates constants, and C y is as
/// smooth as y only where C is the same from node to node.
struct Preparation {
  explicit Preparation(const Blocks& blocks);

  /// Of known unknowns the round, from 1, in which the values of those before give theirs;
  /// undetermined or bordering; 0 of all others.
  OfUnknowns known_in;
  int rounds = 0;
  OfUnknowns row_scale, scale;                  ///< diagonals of R and C
  std::vector<std::string> remarks{}, notes{};  ///< as those of System
};

/// Takes entries out that are at most this part of the largest one of their row and of their column
/// in their block: sums of elements leave 1e-17 where nothing is coupled, and graphs of nodes,
/// patches and coarse levels would be made of them. Diagonals stay. Collective.
void drop_negligible(Blocks& blocks, double part, Preparation& preparation);

/// Brings typical diagonals of A, rows of B2 and columns of B1T to numbers between 1 and 4 by one
/// factor for the rows, and one for the columns, of each field: residuals, and what compares
/// entries, then do not depend on units. Symmetric where K is. Collective.
void scale_fields(Blocks& blocks, Preparation& preparation);

/// Unknowns whose row holds only the diagonal d, or beside it nothing that counts (penalties, of
/// 1e12 times the typical diagonal and more), are known by b/d. Their columns go; rows that then
/// hold only the diagonal are those of the next round. Collective.
void take_out_known(Blocks& blocks, Preparation& preparation);

/// Scalars that are coupled with a fifth of all unknowns of a field and more, as the multiplier of
/// a mean value, would make neighbours of all nodes; these, while they are few, and the scalars
/// whose rows a file excludes become the border of K, and leave unit rows. Throws tunica::Error on
/// all ranks for a row that is not that of a free scalar. Collective.
void take_out_border(Blocks& blocks, const std::vector<long long>& excluded,
                     Preparation& preparation);

/// Rows whose entries beside the diagonal differ by a factor of 10⁴ and more from those of their
/// columns get the size of these; a diagonal of 1e6 times what is beside it (a weaker penalty) is
/// divided by its size in row and column alike. Collective.
void scale_outlying_rows(Blocks& blocks, Preparation& preparation);

}  // namespace tunica::systems
