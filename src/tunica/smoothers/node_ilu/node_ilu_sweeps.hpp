#pragma once
#include <cstddef>
#include <cstdint>

namespace tunica::smoothers {

/// Rows of blocks between nodes. A node has width unknowns, or the last of them alone: the block of
/// a row's and a column's node has as many rows and columns as these have unknowns. Vectors have
/// width values for each node all the same.
struct BlockPattern {
  int width, n_nodes;            ///< width 2, 3 or 4; nodes that have rows
  const std::uint8_t* unknowns;  ///< of each node: width or 1
  const std::size_t* start;      ///< of each row's columns
  const int* columns;            ///< nodes, ascending
};

/// The blocks of a matrix row by row, each column by column.
template <class Real>
struct NodeMatrix {
  BlockPattern pattern;
  const std::size_t* value_start;  ///< of each row's values
  const Real* values;
};

/// Triangular factors in such blocks. In each row of U the inverse of its diagonal block is first.
template <class Real>
struct NodeFactors {
  BlockPattern pattern;                          ///< of both together, the diagonal among them
  const std::size_t* diagonal;                   ///< place of each node in the columns of its row
  const std::size_t *lower_start, *upper_start;  ///< of each row's values
  const Real *lower, *upper;
};

/// x ← (L U)⁻¹ x.
void solve_factors(const NodeFactors<float>& factors, double* x);
void solve_factors(const NodeFactors<double>& factors, double* x);

/// r −= K x; x has values of all columns' nodes.
void subtract_product(const NodeMatrix<float>& K, const double* x, double* r);
void subtract_product(const NodeMatrix<double>& K, const double* x, double* r);

/// C −= A B for blocks of width² values.
void subtract_product(int width, const double* A, const double* B, double* C);

}  // namespace tunica::smoothers
