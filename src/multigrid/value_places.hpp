#pragma once
#include <vector>

#include "base/types.hpp"

namespace tunica::multigrid {

/// Where a matrix that is part of another finds its values there: for each of its values the index
/// among those of the whole. rows, columns: the numbers in the whole of its local rows and columns.
/// The rank's rows must be its own in both.
std::vector<int> value_places(const CrsMatrix& part, const std::vector<GlobalOrdinal>& rows,
                              const std::vector<GlobalOrdinal>& columns, const CrsMatrix& whole);
/// For a part with the numbers of the whole.
std::vector<int> value_places(const CrsMatrix& part, const CrsMatrix& whole);

}  // namespace tunica::multigrid
