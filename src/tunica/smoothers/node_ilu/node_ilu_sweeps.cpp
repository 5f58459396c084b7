#include "tunica/smoothers/node_ilu/node_ilu_sweeps.hpp"

#include "tunica/base/clones.hpp"

namespace tunica::smoothers {

namespace {

/// y −= M x. Inlined, so that each caller has it for its own processors.
template <int rows, int columns, class Real>
[[gnu::always_inline]] inline void subtract(const Real* __restrict__ M,
                                            const double* __restrict__ x, double* __restrict__ y) {
  for (int c = 0; c < columns; ++c)
    for (int i = 0; i < rows; ++i) y[i] -= M[rows * c + i] * x[c];
}

/// y_i −= Σ_k M_ik x_k for the blocks of a row from and up to these columns; y_i has so many
/// values.
template <int width, int rows, class Real>
[[gnu::always_inline]] inline void subtract_row(const BlockPattern& pattern, std::size_t first,
                                                std::size_t last, const Real* M, const double* x,
                                                double* y_i) {
  double y[rows];
  for (int i = 0; i < rows; ++i) y[i] = y_i[i];
  for (std::size_t k = first; k < last; ++k) {
    const int node = pattern.columns[k];
    const double* const x_k = x + static_cast<std::size_t>(width) * node;
    // Widths are constants of the compiler: blocks of 4, 3 or 2, or the scalar alone.
    if (pattern.unknowns[node] == width) {
      subtract<rows, width>(M, x_k, y);
      M += rows * width;
    } else {
      subtract<rows, 1>(M, x_k + width - 1, y);
      M += rows;
    }
  }
  for (int i = 0; i < rows; ++i) y_i[i] = y[i];
}

/// The same for a row of either kind; y has values of all nodes.
template <int width, class Real>
[[gnu::always_inline]] inline void subtract_row(const BlockPattern& pattern, int node,
                                                std::size_t first, std::size_t last, const Real* M,
                                                const double* x, double* y) {
  double* const y_i = y + static_cast<std::size_t>(width) * node;
  if (pattern.unknowns[node] == width)
    subtract_row<width, width>(pattern, first, last, M, x, y_i);
  else
    subtract_row<width, 1>(pattern, first, last, M, x, y_i + width - 1);
}

/// y ← M y.
template <int rows, class Real>
[[gnu::always_inline]] inline void multiply(const Real* M, double* y) {
  double z[rows] = {};
  subtract<rows, rows>(M, y, z);
  for (int i = 0; i < rows; ++i) y[i] = -z[i];
}

template <int width, class Real>
[[gnu::always_inline]] inline void solve(const NodeFactors<Real>& f, double* x) {
  const BlockPattern& pattern = f.pattern;
  // y_i = x_i − Σ_k<i L_ik y_k
  for (int node = 0; node < pattern.n_nodes; ++node)
    subtract_row<width>(pattern, node, pattern.start[node], f.diagonal[node],
                        f.lower + f.lower_start[node], x, x);
  // x_i = D_i⁻¹ (y_i − Σ_k>i U_ik x_k)
  for (int node = pattern.n_nodes - 1; node >= 0; --node) {
    const int n = pattern.unknowns[node];
    const Real* const inverse = f.upper + f.upper_start[node];
    subtract_row<width>(pattern, node, f.diagonal[node] + 1, pattern.start[node + 1],
                        inverse + n * n, x, x);
    double* const x_i = x + static_cast<std::size_t>(width) * node;
    if (n == width)
      multiply<width>(inverse, x_i);
    else
      multiply<1>(inverse, x_i + width - 1);
  }
}

template <class Real>
[[gnu::always_inline]] inline void solve_any(const NodeFactors<Real>& f, double* x) {
  if (f.pattern.width == 4) return solve<4>(f, x);
  if (f.pattern.width == 3) return solve<3>(f, x);
  solve<2>(f, x);
}

template <int width, class Real>
[[gnu::always_inline]] inline void subtract_rows(const NodeMatrix<Real>& K, const double* x,
                                                 double* r) {
  for (int node = 0; node < K.pattern.n_nodes; ++node)
    subtract_row<width>(K.pattern, node, K.pattern.start[node], K.pattern.start[node + 1],
                        K.values + K.value_start[node], x, r);
}

template <class Real>
[[gnu::always_inline]] inline void subtract_any(const NodeMatrix<Real>& K, const double* x,
                                                double* r) {
  if (K.pattern.width == 4) return subtract_rows<4>(K, x, r);
  if (K.pattern.width == 3) return subtract_rows<3>(K, x, r);
  subtract_rows<2>(K, x, r);
}

template <int width>
[[gnu::always_inline]] inline void subtract_blocks(const double* A, const double* B, double* C) {
  for (int c = 0; c < width; ++c) subtract<width, width>(A, B + width * c, C + width * c);
}

}  // namespace

TUNICA_CLONES void solve_factors(const NodeFactors<float>& factors, double* x) {
  solve_any(factors, x);
}
TUNICA_CLONES void solve_factors(const NodeFactors<double>& factors, double* x) {
  solve_any(factors, x);
}

TUNICA_CLONES void subtract_product(const NodeMatrix<float>& K, const double* x, double* r) {
  subtract_any(K, x, r);
}
TUNICA_CLONES void subtract_product(const NodeMatrix<double>& K, const double* x, double* r) {
  subtract_any(K, x, r);
}

TUNICA_CLONES void subtract_product(int width, const double* A, const double* B, double* C) {
  if (width == 4) return subtract_blocks<4>(A, B, C);
  if (width == 3) return subtract_blocks<3>(A, B, C);
  subtract_blocks<2>(A, B, C);
}

}  // namespace tunica::smoothers
