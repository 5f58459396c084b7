#include "tunica/stepping/spline.hpp"

#include <Teuchos_LAPACK.hpp>
#include <algorithm>

#include "tunica/base/error.hpp"

namespace tunica::stepping {

namespace {

/// A tridiagonal matrix and right-hand sides, by columns.
struct Tridiagonal {
  std::vector<double> below, diagonal, above;
  std::vector<double> columns;

  explicit Tridiagonal(std::size_t n) : below(n - 1), diagonal(n), above(n - 1) {}

  /// Replaces the right-hand sides by the solutions.
  void solve() {
    const int n = static_cast<int>(diagonal.size());
    std::vector<double> second(std::max(n - 2, 1));
    std::vector<int> pivots(n);
    int info = 0;
    Teuchos::LAPACK<int, double> lapack;
    lapack.GTTRF(n, below.data(), diagonal.data(), above.data(), second.data(), pivots.data(),
                 &info);
    TUNICA_ASSERT(info == 0, "the matrix of a spline has a dominant diagonal");
    lapack.GTTRS('N', n, static_cast<int>(columns.size()) / n, below.data(), diagonal.data(),
                 above.data(), second.data(), pivots.data(), columns.data(), n, &info);
  }
};

/// Slopes at all times but the first and last, which are zero.
std::vector<double> slopes_between(const std::vector<double>& h, const std::vector<double>& s) {
  std::vector<double> slopes(h.size() + 1, 0.0);
  if (h.size() < 2) return slopes;
  Tridiagonal system(h.size() - 1);
  for (std::size_t i = 1; i < h.size(); ++i) {
    system.diagonal[i - 1] = 2.0 * (h[i - 1] + h[i]);
    if (i > 1) system.below[i - 2] = h[i];
    if (i + 1 < h.size()) system.above[i - 1] = h[i - 1];
    system.columns.push_back(3.0 * (h[i] * s[i - 1] + h[i - 1] * s[i]));
  }
  system.solve();
  std::copy(system.columns.begin(), system.columns.end(), slopes.begin() + 1);
  return slopes;
}

// The matrix is tridiagonal but for its corners, T + u vᵀ with u = (g, 0…0, b), v = (1, 0…0, a/g):
// m = y − (v·y)/(1 + v·z) z, T y = rhs, T z = u (Sherman and Morrison).
std::vector<double> periodic_slopes(const std::vector<double>& h, const std::vector<double>& s) {
  const std::size_t n = h.size();
  Tridiagonal system(n);
  std::vector<double> rhs(n), u(n, 0.0);
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t before = (i + n - 1) % n;
    system.diagonal[i] = 2.0 * (h[before] + h[i]);
    if (i > 0) system.below[i - 1] = h[i];
    if (i + 1 < n) system.above[i] = h[before];
    rhs[i] = 3.0 * (h[i] * s[before] + h[before] * s[i]);
  }
  const double first_corner = h[0],
               last_corner = h[n - 2];  // of m_{n−1} in row 0, m_0 in row n − 1
  const double g = -system.diagonal[0];
  system.diagonal[0] -= g;
  system.diagonal[n - 1] -= last_corner * first_corner / g;
  u[0] = g;
  u[n - 1] = last_corner;
  system.columns = rhs;
  system.columns.insert(system.columns.end(), u.begin(), u.end());
  system.solve();
  const double *y = system.columns.data(), *z = y + n;
  const auto v_dot = [&](const double* x) { return x[0] + first_corner / g * x[n - 1]; };
  const double factor = v_dot(y) / (1.0 + v_dot(z));
  std::vector<double> slopes(n + 1);
  for (std::size_t i = 0; i < n; ++i) slopes[i] = y[i] - factor * z[i];
  slopes[n] = slopes[0];
  return slopes;
}

}  // namespace

Spline::Spline(std::vector<double> times, std::vector<double> values, bool is_periodic)
    : times_(std::move(times)), values_(std::move(values)) {
  std::vector<double> h, s;
  for (std::size_t i = 0; i + 1 < times_.size(); ++i) {
    h.push_back(times_[i + 1] - times_[i]);
    s.push_back((values_[i + 1] - values_[i]) / h.back());
  }
  slopes_ = is_periodic ? periodic_slopes(h, s) : slopes_between(h, s);
}

double Spline::operator()(double t) const {
  const auto next = std::upper_bound(times_.begin() + 1, times_.end() - 1, t);
  const std::size_t i = next - times_.begin() - 1;
  const double h = times_[i + 1] - times_[i], x = (t - times_[i]) / h, y = 1.0 - x;
  // Hermite's cubic
  return y * y * (1.0 + 2.0 * x) * values_[i] + x * x * (1.0 + 2.0 * y) * values_[i + 1] +
         h * x * y * (y * slopes_[i] - x * slopes_[i + 1]);
}

}  // namespace tunica::stepping
