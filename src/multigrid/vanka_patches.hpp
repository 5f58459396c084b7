#pragma once
#include <cstddef>
#include <vector>

#include "multigrid/mixed_numbering.hpp"

namespace tunica::multigrid {

/// The patches of Vanka's smoother on the rows of one rank: one per pressure row, which comes
/// last in it, with the velocity rows that its row of B2 reaches. Rows of other ranks are left
/// out. Depends on the values only in what is zero: eliminated velocities are in no patch.
struct VankaPatches {
  std::vector<std::size_t> start;  ///< size: patches + 1
  std::vector<int> rows;           ///< local rows, patch after patch
  std::vector<int> lone_rows;      ///< velocity rows in no patch
  std::vector<int> column_of_row;  ///< local column of each local row

  int n_patches() const { return static_cast<int>(start.size()) - 1; }
  int size(int patch) const { return static_cast<int>(start[patch + 1] - start[patch]); }
  int largest() const;
};

/// is_pressure: one flag per local row of K.
VankaPatches make_vanka_patches(const CrsMatrix& K, const std::vector<char>& is_pressure);

/// Flags of the pressure rows.
std::vector<char> scalar_rows(const CrsMatrix& K, const MixedNumbering& numbering);

}  // namespace tunica::multigrid
