#include "tunica/smoothers/dense/dense.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "tunica/base/clones.hpp"

namespace tunica::smoothers {

namespace {

constexpr int width = 8;  ///< columns that are eliminated together

// All of it is inlined, to be made for the same processors as invert_dense().

/// Eliminates the columns of a panel in all rows, with row exchanges below its first row: the
/// elimination of columns k .. k+width-1 of a matrix as far as these columns go. What remains in
/// them is what the elimination makes of the other columns, see update(). panel: n rows of width.
[[gnu::always_inline]] inline bool eliminate(int n, int k, int columns, double* panel,
                                             int* exchanged) {
  // Step c of Gauss and Jordan: the pivot's row over the pivot is subtracted from all others, and
  // column c becomes that of the inverse, 1/pivot and −factor/pivot.
  for (int c = 0; c < columns; ++c) {
    int pivot_row = k + c;
    for (int i = k + c + 1; i < n; ++i)
      if (std::abs(panel[i * width + c]) > std::abs(panel[pivot_row * width + c])) pivot_row = i;
    const double pivot = panel[pivot_row * width + c];
    if (!(std::abs(pivot) > 0.0) || !std::isfinite(pivot)) return false;
    exchanged[k + c] = pivot_row;
    double* const row = panel + (k + c) * width;
    if (pivot_row != k + c) std::swap_ranges(row, row + width, panel + pivot_row * width);
    row[c] = 1.0;
    double scaled[width];  // a copy: the compiler then knows that no other row is it
    for (int j = 0; j < width; ++j) scaled[j] = row[j] / pivot;
    for (int i = 0; i < n; ++i) {
      double* const other = panel + i * width;
      const double factor = other[c];
      for (int j = 0; j < width; ++j) other[j] -= factor * scaled[j];
      other[c] =
          -factor * scaled[c];  // afterwards: what is stored one by one is slow to load as a whole
    }
    std::copy_n(scaled, width, row);
  }
  return true;
}

/// row += Σ_c factors_c pivots_c over the rows of the panel.
[[gnu::always_inline]] inline void update(int n, const double* __restrict__ factors,
                                          const double* __restrict__ pivots,
                                          double* __restrict__ row) {
  double f[width];
  std::copy_n(factors, width, f);
  for (int j = 0; j < n; ++j) {
    double low = row[j], high = 0.0;
    for (int c = 0; c < width; c += 2) {
      low += f[c] * pivots[c * n + j];
      high += f[c + 1] * pivots[(c + 1) * n + j];
    }
    row[j] = low + high;
  }
}

/// a ← T a in all columns but those of the panel, T the identity but for the panel's columns.
[[gnu::always_inline]] inline void update_others(int n, int k, int columns, const double* panel,
                                                 double* pivots, double* a) {
  // The panel's rows, without its columns, are the pivots; T replaces them, hence the zeros.
  std::fill_n(pivots, width * n, 0.0);
  for (int c = 0; c < columns; ++c) {
    double* const row = a + (k + c) * n;
    std::copy_n(row, n, pivots + c * n);
    std::fill_n(pivots + c * n + k, columns, 0.0);
    std::fill_n(row, n, 0.0);
  }
  for (int i = 0; i < n; ++i) {
    update(n, panel + i * width, pivots, a + i * n);
    std::copy_n(panel + i * width, columns, a + i * n + k);
  }
}

}  // namespace

// A ← T_m … T_1 A with a T for each panel of eight columns: what a panel makes of the other columns
// is then one product of matrices, in place of eight passes over them.
TUNICA_CLONES bool invert_dense(int n, double* a, DenseScratch& scratch) {
  scratch.exchanged.resize(n);
  scratch.panel.resize(n * width);
  scratch.pivots.resize(n * width);
  double* const panel = scratch.panel.data();
  for (int k = 0; k < n; k += width) {
    const int columns = std::min(width, n - k);
    for (int i = 0; i < n; ++i) {
      std::copy_n(a + i * n + k, columns, panel + i * width);
      std::fill_n(panel + i * width + columns, width - columns, 0.0);
    }
    if (!eliminate(n, k, columns, panel, scratch.exchanged.data())) return false;
    for (int r = k; r < k + columns; ++r)
      if (scratch.exchanged[r] != r)
        std::swap_ranges(a + r * n, a + (r + 1) * n, a + scratch.exchanged[r] * n);
    update_others(n, k, columns, panel, scratch.pivots.data(), a);
  }
  // (P A)⁻¹ P = A⁻¹: exchanges of rows before are exchanges of columns after, the last one first.
  for (int k = n - 1; k >= 0; --k)
    if (scratch.exchanged[k] != k)
      for (int i = 0; i < n; ++i) std::swap(a[i * n + k], a[i * n + scratch.exchanged[k]]);
  return true;
}

namespace {

/// y = Σ M_c x_c, four columns at a time: y is then read and written a quarter as often.
/// Inlined, so that each of its callers has it for its own processors.
template <class Real>
[[gnu::always_inline]] inline void product(int n, const Real* __restrict__ M,
                                           const double* __restrict__ x, double* __restrict__ y) {
  std::fill_n(y, n, 0.0);
  int c = 0;
  for (; c + 4 <= n; c += 4, M += 4 * static_cast<std::size_t>(n))
    for (int i = 0; i < n; ++i)
      y[i] +=
          (M[i] * x[c] + M[n + i] * x[c + 1]) + (M[2 * n + i] * x[c + 2] + M[3 * n + i] * x[c + 3]);
  for (; c < n; ++c, M += n)
    for (int i = 0; i < n; ++i) y[i] += M[i] * x[c];
}

}  // namespace

TUNICA_CLONES void dense_product(int n, const double* M, const double* x, double* y) {
  product(n, M, x, y);
}
TUNICA_CLONES void dense_product(int n, const float* M, const double* x, double* y) {
  product(n, M, x, y);
}

}  // namespace tunica::smoothers
