#pragma once
#include <vector>

namespace tunica::multigrid {

/// Inverts the n×n matrix in place, row by row in a, by Gauss-Jordan elimination with row
/// exchanges; exchanged is scratch. False where a pivot is zero or not a number.
bool invert_dense(int n, double* a, std::vector<int>& exchanged);

}  // namespace tunica::multigrid
