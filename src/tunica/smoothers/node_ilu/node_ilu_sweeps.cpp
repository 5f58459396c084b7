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

/// The same for the blocks of a row of a node with so many unknowns, from and up to these columns.
template <int width, int rows, class Real>
[[gnu::always_inline]] inline void subtract_row(const BlockPattern& pattern, std::size_t first,
                                                std::size_t last, const Real* M, const double* x,
                                                double* __restrict__ y) {
  for (std::size_t k = first; k < last; ++k) {
    const int node = pattern.columns[k];
    const double* const x_node = x + static_cast<std::size_t>(width) * node;
    if (pattern.unknowns[node] == width) {
      subtract<rows, width>(M, x_node, y);
      M += rows * width;
    } else {
      subtract<rows, 1>(M, x_node + width - 1, y);
      M += rows;
    }
  }
}

/// y_i −= L_ik y_k for k < i.
template <int width, int rows, class Real>
[[gnu::always_inline]] inline void eliminate_row(const NodeFactors<Real>& f, int node,
                                                 const double* x, double* own) {
  double y[rows];
  for (int i = 0; i < rows; ++i) y[i] = own[i];
  subtract_row<width, rows>(f.pattern, f.pattern.start[node], f.diagonal[node],
                            f.lower + f.lower_start[node], x, y);
  for (int i = 0; i < rows; ++i) own[i] = y[i];
}

/// x_i = D_i⁻¹ (y_i − U_ik x_k), k > i.
template <int width, int rows, class Real>
[[gnu::always_inline]] inline void substitute_row(const NodeFactors<Real>& f, int node,
                                                  const double* x, double* own) {
  const Real* const inverse = f.upper + f.upper_start[node];
  double y[rows], z[rows] = {};
  for (int i = 0; i < rows; ++i) y[i] = own[i];
  subtract_row<width, rows>(f.pattern, f.diagonal[node] + 1, f.pattern.start[node + 1],
                            inverse + rows * rows, x, y);
  subtract<rows, rows>(inverse, y, z);
  for (int i = 0; i < rows; ++i) own[i] = -z[i];
}

template <int width, class Real>
[[gnu::always_inline]] inline void solve(const NodeFactors<Real>& f, double* x) {
  for (int node = 0; node < f.pattern.n_nodes; ++node) {
    double* const own = x + static_cast<std::size_t>(width) * node;
    if (f.pattern.unknowns[node] == width)
      eliminate_row<width, width>(f, node, x, own);
    else
      eliminate_row<width, 1>(f, node, x, own + width - 1);
  }
  for (int node = f.pattern.n_nodes - 1; node >= 0; --node) {
    double* const own = x + static_cast<std::size_t>(width) * node;
    if (f.pattern.unknowns[node] == width)
      substitute_row<width, width>(f, node, x, own);
    else
      substitute_row<width, 1>(f, node, x, own + width - 1);
  }
}

template <class Real>
[[gnu::always_inline]] inline void solve_any(const NodeFactors<Real>& f, double* x) {
  if (f.pattern.width == 4) return solve<4>(f, x);
  if (f.pattern.width == 3) return solve<3>(f, x);
  solve<2>(f, x);
}

template <int width, int rows, class Real>
[[gnu::always_inline]] inline void subtract_row_of(const NodeMatrix<Real>& K, int node,
                                                   const double* x, double* r) {
  double y[rows];
  for (int i = 0; i < rows; ++i) y[i] = r[i];
  subtract_row<width, rows>(K.pattern, K.pattern.start[node], K.pattern.start[node + 1],
                            K.values + K.value_start[node], x, y);
  for (int i = 0; i < rows; ++i) r[i] = y[i];
}

template <int width, class Real>
[[gnu::always_inline]] inline void subtract_rows(const NodeMatrix<Real>& K, const double* x,
                                                 double* r) {
  for (int node = 0; node < K.pattern.n_nodes; ++node) {
    double* const own = r + static_cast<std::size_t>(width) * node;
    if (K.pattern.unknowns[node] == width)
      subtract_row_of<width, width>(K, node, x, own);
    else
      subtract_row_of<width, 1>(K, node, x, own + width - 1);
  }
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
