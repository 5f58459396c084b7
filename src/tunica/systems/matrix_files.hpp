#pragma once
#include <string>
#include <vector>

#include "tunica/base/types.hpp"

namespace tunica::systems {

/// A sparse matrix as a file has it, rows and columns counted from 0; each row ascending.
struct FileMatrix {
  long long n_rows = 0, n_columns = 0;
  std::vector<std::size_t> start;  ///< size: rows + 1
  std::vector<long long> columns;
  std::vector<double> values;
};

/// Reads coordinates in the Matrix Market format, general or symmetric. The calling rank alone.
/// Throws tunica::Error that names the file.
FileMatrix read_matrix(const std::string& path);

/// Reads a dense array of one column. The calling rank alone. Throws tunica::Error.
std::vector<double> read_column(const std::string& path);

/// An empty matrix.
FileMatrix empty_matrix(long long n_rows, long long n_columns);
FileMatrix transposed(const FileMatrix& A);

}  // namespace tunica::systems
