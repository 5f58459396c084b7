#pragma once
#include <vector>

#include "tunica/base/types.hpp"

namespace tunica::algebra {

/// The local numbers that a map gives to these.
std::vector<int> local_numbers(const std::vector<GlobalOrdinal>& numbers, const Map& map);

/// Where a matrix that is part of another finds its values there: for each of its values the index
/// among those of the whole. rows, columns: the numbers in the whole of its local rows and columns.
/// The rank's rows must be its own in both.
std::vector<int> entry_offsets(const CrsMatrix& part, const std::vector<GlobalOrdinal>& rows,
                               const std::vector<GlobalOrdinal>& columns, const CrsMatrix& whole);
/// For a part with the numbers of the whole.
std::vector<int> entry_offsets(const CrsMatrix& part, const CrsMatrix& whole);

}  // namespace tunica::algebra
