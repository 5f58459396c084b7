#pragma once
#include <cstddef>

namespace tunica::smoothers {

/// Triangular factors in blocks of width² values, each column by column. Of the diagonal blocks of
/// U, the inverses.
template <class Real>
struct NodeFactors {
  int width, n_nodes;
  const std::size_t *lower_start, *upper_start;  ///< of each node's blocks
  const int *lower_columns, *upper_columns;      ///< nodes
  const Real *lower, *upper, *inverses;
};

/// x ← (L U)⁻¹ x, width values per node; width 2, 3 or 4.
void solve_factors(const NodeFactors<float>& factors, double* x);
void solve_factors(const NodeFactors<double>& factors, double* x);

/// Blocks of a matrix row by row, each column by column.
template <class Real>
struct NodeMatrix {
  int width, n_nodes;
  const std::size_t* start;
  const int* columns;
  const Real* values;
};

/// r −= K x; x has values for all columns' nodes.
void subtract_product(const NodeMatrix<float>& K, const double* x, double* r);
void subtract_product(const NodeMatrix<double>& K, const double* x, double* r);

/// C −= A B for such blocks.
void subtract_product(int width, const double* A, const double* B, double* C);

}  // namespace tunica::smoothers
