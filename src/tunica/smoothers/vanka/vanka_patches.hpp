#pragma once
#include <cstddef>
#include <vector>

#include "tunica/algebra/dof_layout.hpp"

namespace tunica::smoothers {

/// The patches of Vanka's smoother on the rows of one rank. Rows of other ranks are left out.
struct VankaPatches {
  std::vector<std::size_t> start;   ///< size: patches + 1
  std::vector<int> rows;            ///< local rows, patch after patch; a pressure comes last
  std::vector<int> uncovered_rows;  ///< velocity rows in no patch
  std::vector<int> column_of_row;   ///< local column of each local row

  int n_patches() const { return static_cast<int>(start.size()) - 1; }
  int size(int patch) const { return static_cast<int>(start[patch + 1] - start[patch]); }
  int largest() const;
};

/// One patch per pressure row with the velocity rows that its row of B2 reaches, ascending.
/// Depends on the values only in what is zero: eliminated velocities are in no patch.
/// is_pressure: one flag per local row of K.
VankaPatches make_vanka_patches(const CrsMatrix& K, const std::vector<char>& is_pressure);

/// The same with all velocities of each node that a patch reaches but the uncovered ones. Throws
/// std::invalid_argument where the rows are not nodes of as many velocities and a pressure.
VankaPatches make_nodal_patches(const CrsMatrix& K, const std::vector<char>& is_pressure);

/// One patch per pair of nodes whose pressures are neighbours in the graph of K, with the
/// unknowns of both but the uncovered rows of make_vanka_patches().
VankaPatches make_pair_patches(const CrsMatrix& K, const std::vector<char>& is_pressure);

/// Notes which entries of the pressure rows are not zero: with the graph, all that the patches
/// depend on. True where this differs from what was noted before.
bool update_b2_pattern(const CrsMatrix& K, const std::vector<char>& is_pressure,
                       std::vector<char>& reaches);

/// Velocity rows per node. Throws as make_nodal_patches() does.
int velocities_per_node(const std::vector<char>& is_pressure);

/// Flags of the pressure rows.
std::vector<char> scalar_rows(const CrsMatrix& K, const algebra::DofLayout& numbering);

}  // namespace tunica::smoothers
