#pragma once
#include <string>
#include <vector>

#include "tunica/systems/matrix_rows.hpp"

namespace tunica::systems {

/// Reads coordinates in the Matrix Market format, general or symmetric. Rank 0 reads so many lines
/// at once and hands on what they say. Throws the same tunica::Error on all ranks, which names the
/// file. Collective.
MatrixRows read_matrix(const std::string& path, const CommPtr& comm,
                       std::size_t lines_at_once = entries_at_once);

/// The portion of a column that a rank has.
struct ColumnRows {
  long long n_rows = 0;  ///< of all ranks
  std::vector<double> values;
};

/// Reads a dense array of so many columns in the same way. Collective.
std::vector<ColumnRows> read_columns(const std::string& path, const CommPtr& comm, int count,
                                     std::size_t lines_at_once = entries_at_once);
/// One with one column.
ColumnRows read_column(const std::string& path, const CommPtr& comm,
                       std::size_t lines_at_once = entries_at_once);

}  // namespace tunica::systems
