#pragma once
#include <cstddef>
#include <cstdint>
#include <cstring>

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

/// The blocks of a matrix, row behind row, each block column by column.
template <class Real>
struct NodeMatrix {
  BlockPattern pattern;
  const Real* values;
};

/// The upper half of a float: its range, and eight binary digits.
struct Half {
  std::uint16_t bits;
};
inline float widened(Half half) {
  const std::uint32_t bits = static_cast<std::uint32_t>(half.bits) << 16;
  float value;
  std::memcpy(&value, &bits, sizeof(value));
  return value;
}
/// To the nearest.
inline Half rounded(float value) {
  if (!(value == value)) return {0x7fc0};  // no number, whose digits might all be cut off
  std::uint32_t bits;
  std::memcpy(&bits, &value, sizeof(bits));
  return {static_cast<std::uint16_t>((bits + 0x7fff + (bits >> 16 & 1)) >> 16)};
}

/// Triangular factors in such blocks, stored as solve_factors() walks over them.
template <class Stored, class Real>
struct NodeFactors {
  BlockPattern pattern;         ///< of both together, the diagonal among them
  const std::size_t* diagonal;  ///< place of each node in the columns of its row
  const Stored* lower;          ///< row behind row
  const Stored* upper;          ///< the last row first, without the diagonal
  const Real* inverses;         ///< of the diagonal blocks, width² values for each node
};

/// x ← (L U)⁻¹ x.
void solve_factors(const NodeFactors<Half, float>& factors, float* x);
void solve_factors(const NodeFactors<float, float>& factors, float* x);
void solve_factors(const NodeFactors<double, double>& factors, double* x);

/// r = b − K x for the nodes that have rows; x has values of all columns' nodes.
void find_residual(const NodeMatrix<float>& K, const double* b, const double* x, double* r);
void find_residual(const NodeMatrix<double>& K, const double* b, const double* x, double* r);

/// The blocks of a row of U behind the diagonal, in these columns of the pattern.
template <class Stored>
struct UpperRow {
  int node;
  std::size_t first, last;
  const Stored* values;
};

/// K_i· ← K_i· − F U_k· in a row of K whose blocks have width² values each: that of a node's column
/// is the slot-th, -1 where the row lacks it.
void subtract_upper(const BlockPattern& pattern, const UpperRow<Half>& U, const double* F,
                    const int* slots, double* row);
void subtract_upper(const BlockPattern& pattern, const UpperRow<float>& U, const double* F,
                    const int* slots, double* row);
void subtract_upper(const BlockPattern& pattern, const UpperRow<double>& U, const double* F,
                    const int* slots, double* row);

/// C −= A B for blocks of width² values.
void subtract_product(int width, const double* A, const double* B, double* C);

}  // namespace tunica::smoothers
