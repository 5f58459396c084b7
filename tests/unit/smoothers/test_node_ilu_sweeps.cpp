#include <Teuchos_UnitTestHarness.hpp>
#include <limits>

#include "tunica/smoothers/node_ilu/node_ilu.hpp"
#include "tunica/smoothers/node_ilu/node_ilu_sweeps.hpp"
#include "unit/algebra/distance.hpp"
#include "unit/smoothers/dense_sweep.hpp"

namespace {

using namespace tunica;
using smoothers::Half;
using smoothers::Precision;
using test::largest_distance;
using test::WallMatrix;

TEUCHOS_UNIT_TEST(node_ilu, sweeps_in_one_go_are_sweeps_one_after_the_other) {
  const WallMatrix wall;
  const Vector b = wall.scattered(1);
  using Start = smoothers::NodeIlu::Start;
  for (const Precision precision : {Precision::full, Precision::single, Precision::half}) {
    const auto factors = smoothers::make_node_ilu(*wall.K(), {}, {0, precision});
    factors->refresh();
    const double tolerance = precision == Precision::full ? 1e-12 : 1e-5;
    Vector x = wall.scattered(2), expected(x, Teuchos::Copy);
    factors->sweep({0.7, 0.9}, Start::given, b, x);
    for (const double damping : {0.7, 0.9}) factors->smooth(damping, b, expected);
    TEST_COMPARE(largest_distance(x, expected), <, tolerance);
    factors->sweep({0.7, 0.9}, Start::zero, b, x);
    factors->smooth_from_zero(0.7, b, expected);
    factors->smooth(0.9, b, expected);
    TEST_COMPARE(largest_distance(x, expected), <, tolerance);
  }
}

TEUCHOS_UNIT_TEST(node_ilu_sweeps, halves_are_the_nearest_of_eight_digits) {
  for (const double size : {1e-30, 1e-3, 1.0, 1e4, 1e30})
    for (int i = 0; i < 1000; ++i) {
      const auto value = static_cast<float>(size * test::scatter(i));
      const float half = smoothers::widened(smoothers::rounded(value));
      TEST_COMPARE(std::abs(half - value), <=, std::ldexp(std::abs(value), -8));
    }
  for (const float exact : {0.0f, 1.0f, -0.75f, 1.9921875f})
    TEST_EQUALITY(smoothers::widened(smoothers::rounded(exact)), exact);
  const float none = std::numeric_limits<float>::quiet_NaN();
  TEST_ASSERT(std::isnan(smoothers::widened(smoothers::rounded(none))));
}

void keep(double value, Half& kept) { kept = smoothers::rounded(static_cast<float>(value)); }
void keep(double value, float& kept) { kept = static_cast<float>(value); }
void keep(double value, double& kept) { kept = value; }
double number(Half kept) { return smoothers::widened(kept); }
double number(double kept) { return kept; }

/// Factors of nodes in a line, of width unknowns or the last of them alone, and the same as full
/// matrices of the values that are kept.
template <class Stored, class Real>
struct Example {
  static constexpr int n_nodes = 23;
  int width, n;
  std::vector<std::uint8_t> unknowns;
  std::vector<std::size_t> start{0}, diagonal;
  std::vector<int> columns;
  std::vector<Stored> lower, upper;
  std::vector<Real> inverses, matrix;
  std::vector<double> L, U, K;  ///< U: with the inverses of its diagonal blocks

  explicit Example(int unknowns_of_a_node)
      : width(unknowns_of_a_node), n(width * n_nodes), L(n * n, 0.0), U(n * n, 0.0), K(n * n, 0.0) {
    for (int node = 0; node < n_nodes; ++node)
      unknowns.push_back(static_cast<std::uint8_t>(node % 5 == 2 ? 1 : width));
    inverses.resize(width * n);
    for (int node = 0; node < n_nodes; ++node) {
      for (int other = 0; other < n_nodes; ++other) {
        if (std::abs(node - other) > 3 && (node + other) % 7 != 0 && node != other) continue;
        if (other == node) diagonal.push_back(columns.size());
        columns.push_back(other);
        add(node, other, matrix, K);
        if (other < node) add(node, other, lower, L);
      }
      start.push_back(columns.size());
    }
    for (int node = n_nodes - 1; node >= 0; --node) {
      for (std::size_t k = diagonal[node] + 1; k < start[node + 1]; ++k)
        add(node, columns[k], upper, U);
      std::vector<Real> inverse;
      add(node, node, inverse, U);
      std::copy(inverse.begin(), inverse.end(), inverses.begin() + width * width * node);
    }
  }

  smoothers::BlockPattern pattern() const {
    return {width, n_nodes, unknowns.data(), start.data(), columns.data()};
  }

private:
  template <class Kept>
  void add(int node, int other, std::vector<Kept>& values, std::vector<double>& full) const {
    for (int c = width - unknowns[other]; c < width; ++c)
      for (int r = width - unknowns[node]; r < width; ++r) {
        const int i = width * node + r, j = width * other + c;
        values.emplace_back();
        keep(0.1 * test::scatter(31.0 * i + j), values.back());
        full[n * i + j] = number(values.back());
      }
  }
};

template <class Stored, class Real>
void check(int width, double tolerance, Teuchos::FancyOStream& out, bool& success) {
  const Example<Stored, Real> e(width);
  const int n = e.n;
  std::vector<Real> x(n), b(n, Real(0));
  for (int i = 0; i < n; ++i)
    if (width - i % width <= e.unknowns[i / width]) keep(test::scatter(i), b[i]);
  // y = b − L y, then x_i = D_i⁻¹ (y_i − Σ_k>i U_ik x_k)
  std::vector<double> expected(b.begin(), b.end());
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) expected[i] -= e.L[n * i + j] * expected[j];
  for (int node = e.n_nodes - 1; node >= 0; --node) {
    for (int i = width * node; i < width * (node + 1); ++i)
      for (int j = width * (node + 1); j < n; ++j) expected[i] -= e.U[n * i + j] * expected[j];
    const std::vector<double> y(expected.begin() + width * node,
                                expected.begin() + width * (node + 1));
    for (int i = width * node; i < width * (node + 1); ++i) {
      expected[i] = 0.0;
      for (int j = 0; j < width; ++j) expected[i] += e.U[n * i + width * node + j] * y[j];
    }
  }
  x = b;
  solve_factors(smoothers::NodeFactors<Stored, Real>{e.pattern(), e.diagonal.data(), e.lower.data(),
                                                     e.upper.data(), e.inverses.data()},
                x.data());
  for (int i = 0; i < n; ++i) TEST_COMPARE(std::abs(x[i] - expected[i]), <, tolerance);
  const std::vector<double> wide(x.begin(), x.end());
  const std::vector<double> given(b.begin(), b.end());
  std::vector<double> r(n);
  find_residual(smoothers::NodeMatrix<Real>{e.pattern(), e.matrix.data()}, given.data(),
                wide.data(), r.data());
  for (int i = 0; i < n; ++i) {
    double rest = b[i];
    for (int j = 0; j < n; ++j) rest -= e.K[n * i + j] * x[j];
    TEST_COMPARE(std::abs(r[i] - rest), <, 1e-13);
  }
}

TEUCHOS_UNIT_TEST(node_ilu_sweeps, are_those_of_full_matrices) {
  for (const int width : {2, 3, 4}) {
    check<double, double>(width, 1e-13, out, success);
    check<float, float>(width, 1e-5, out, success);
    check<Half, float>(width, 1e-5, out, success);
  }
}

}  // namespace
