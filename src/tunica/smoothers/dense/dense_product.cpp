#include "tunica/smoothers/dense/dense_product.hpp"

#include <algorithm>
#include <cstddef>

#include "tunica/base/clones.hpp"

namespace tunica::smoothers {

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
