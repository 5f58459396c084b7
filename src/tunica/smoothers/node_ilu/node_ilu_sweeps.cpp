#include "tunica/smoothers/node_ilu/node_ilu_sweeps.hpp"

#include "tunica/base/clones.hpp"

namespace tunica::smoothers {

namespace {

/// y −= M x. Inlined, so that each caller has it for its own processors.
template <int width, class Real>
[[gnu::always_inline]] inline void subtract(const Real* __restrict__ M,
                                            const double* __restrict__ x, double* __restrict__ y) {
  for (int c = 0; c < width; ++c)
    for (int i = 0; i < width; ++i) y[i] -= M[width * c + i] * x[c];
}

template <int width, class Real>
[[gnu::always_inline]] inline void solve(const NodeFactors<Real>& f, double* x) {
  constexpr int size = width * width;
  for (int node = 0; node < f.n_nodes; ++node) {
    double y[width];
    for (int i = 0; i < width; ++i) y[i] = x[width * node + i];
    for (std::size_t k = f.lower_start[node]; k < f.lower_start[node + 1]; ++k)
      subtract<width>(f.lower + size * k, x + width * f.lower_columns[k], y);
    for (int i = 0; i < width; ++i) x[width * node + i] = y[i];
  }
  for (int node = f.n_nodes - 1; node >= 0; --node) {
    double y[width], z[width] = {};
    for (int i = 0; i < width; ++i) y[i] = x[width * node + i];
    for (std::size_t k = f.upper_start[node]; k < f.upper_start[node + 1]; ++k)
      subtract<width>(f.upper + size * k, x + width * f.upper_columns[k], y);
    subtract<width>(f.inverses + size * static_cast<std::size_t>(node), y, z);
    for (int i = 0; i < width; ++i) x[width * node + i] = -z[i];
  }
}

template <class Real>
[[gnu::always_inline]] inline void solve_any(const NodeFactors<Real>& f, double* x) {
  if (f.width == 4) return solve<4>(f, x);
  if (f.width == 3) return solve<3>(f, x);
  solve<2>(f, x);
}

template <int width, class Real>
[[gnu::always_inline]] inline void subtract_rows(const NodeMatrix<Real>& K, const double* x,
                                                 double* r) {
  for (int node = 0; node < K.n_nodes; ++node) {
    double y[width];
    for (int i = 0; i < width; ++i) y[i] = r[width * node + i];
    for (std::size_t k = K.start[node]; k < K.start[node + 1]; ++k)
      subtract<width>(K.values + width * width * k, x + width * K.columns[k], y);
    for (int i = 0; i < width; ++i) r[width * node + i] = y[i];
  }
}

template <class Real>
[[gnu::always_inline]] inline void subtract_any(const NodeMatrix<Real>& K, const double* x,
                                                double* r) {
  if (K.width == 4) return subtract_rows<4>(K, x, r);
  if (K.width == 3) return subtract_rows<3>(K, x, r);
  subtract_rows<2>(K, x, r);
}

template <int width>
[[gnu::always_inline]] inline void subtract_blocks(const double* A, const double* B, double* C) {
  for (int c = 0; c < width; ++c) subtract<width>(A, B + width * c, C + width * c);
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
