#pragma once
#include <vector>

namespace tunica::smoothers {

/// Work space of invert_dense(), kept from one matrix to the next.
struct DenseScratch {
  std::vector<int> exchanged;
  std::vector<double> panel, pivots;
};

/// Inverts the n×n matrix in place, row by row in a, by Gauss-Jordan elimination of several
/// columns at a time with row exchanges. False where a pivot is zero or not a number.
bool invert_dense(int n, double* a, DenseScratch& scratch);

/// y = M x, M of n rows and columns, column by column.
void dense_product(int n, const double* M, const double* x, double* y);
void dense_product(int n, const float* M, const double* x, double* y);

}  // namespace tunica::smoothers
