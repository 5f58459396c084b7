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

/// The rows of a mixed matrix on one rank.
struct MixedRows {
  std::vector<char> is_pressure;  ///< of each local row
  /// Vertex of the unknown of each local row, numbered from zero; required for patches of whole
  /// vertices only, otherwise it may be empty.
  std::vector<int> place;
};

/// The kinds of the rows of K. Nodes with a host on the same rank (NodeIluOptions) have its place.
MixedRows mixed_rows(const CrsMatrix& K, const algebra::DofLayout& numbering,
                     const Teuchos::RCP<const Vector>& hosts = Teuchos::null);

/// The rows of each place, velocities before pressures.
struct RowsOfPlaces {
  std::vector<std::size_t> start;  ///< size: places + 1
  std::vector<int> rows;
  std::vector<int> n_velocities;  ///< of each place

  int n_places() const { return static_cast<int>(n_velocities.size()); }
  bool has_pressure(int place) const {
    return start[place] + n_velocities[place] < start[place + 1];
  }
};
/// Throws std::invalid_argument where a row has no place.
RowsOfPlaces rows_of_places(const MixedRows& mixed);

/// One patch per pressure row with the velocity rows that its row of B2 reaches, ascending.
/// Depends on the values only in what is zero: eliminated velocities are in no patch.
VankaPatches make_vanka_patches(const CrsMatrix& K, const std::vector<char>& is_pressure);

/// Patches with all velocities of each place that they reach, except the uncovered ones.
VankaPatches make_nodal_patches(const CrsMatrix& K, const MixedRows& mixed);

/// One patch per pair of places of which pressures are neighbours in the graph of K, with the
/// unknowns of both but the uncovered rows of make_vanka_patches(). A place without pressure is
/// paired with those whose pressures reach its velocities. Two places without velocities make a
/// patch of pressures alone, which is singular where C is zero.
VankaPatches make_pair_patches(const CrsMatrix& K, const MixedRows& mixed);

/// Notes which entries of the pressure rows are not zero: with the graph, all that the patches
/// depend on. True where this differs from what was noted before.
bool update_b2_pattern(const CrsMatrix& K, const std::vector<char>& is_pressure,
                       std::vector<char>& reaches);

}  // namespace tunica::smoothers
