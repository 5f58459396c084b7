#pragma once
#include <string>
#include <vector>

#include "tunica/base/types.hpp"

namespace tunica::io {

// Files in the Matrix Market format, https://math.nist.gov/MatrixMarket/formats.html. Rows are
// those of the maps, which must be contiguous on each rank and ascend with the ranks. Numbers are
// printed with as few digits as give the same number back.
//
// Rank 0 writes and replaces the file in one step. Collective. Throws std::runtime_error on all
// ranks where the disk refuses. comment: one line, or "".

/// factor A as general coordinates. All entries of the graph are written, zeros too: the graph is
/// what factors without fill live on.
void write_matrix_market(const std::string& path, const CrsMatrix& A, double factor,
                         const std::string& comment);

/// The parts below each other as one dense array; all have the same number of columns.
void write_matrix_market(const std::string& path, const std::vector<const MultiVector*>& parts,
                         const std::string& comment);

}  // namespace tunica::io
