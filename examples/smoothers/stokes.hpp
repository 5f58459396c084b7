#pragma once
#include <Tpetra_Core.hpp>
#include <Tpetra_CrsMatrix.hpp>
#include <array>
#include <vector>

using Matrix = Tpetra::CrsMatrix<double, int, long long>;
using MultiVector = Tpetra::MultiVector<double, int, long long>;
using Operator = Tpetra::Operator<double, int, long long>;
using Map = Tpetra::Map<int, long long>;

/// Stokes flow of viscosity 1 through the unit cube: n³ cells, velocities and pressure trilinear,
/// stabilised after Brezzi and Pitkäranta. The unknowns of a node stand side by side:
/// 4 * node + i, the pressure last.
///
///   [A  Bᵀ] [u]   [f]      A = ∫ ∇u·∇v,   B = −∫ q ∇·u
///   [B  −C] [p] = [0]      C = h²/12 ∫ ∇p·∇q
///
/// f drives along x; the fluid sticks to all sides but x = 1, where it leaves freely.
class Stokes {
public:
  explicit Stokes(int n) : n_(n) {
    const auto comm = Tpetra::getDefaultComm();
    const long long n_nodes = 1LL * (n + 1) * (n + 1) * (n + 1);
    const Map nodes(n_nodes, 0, comm);  // ranges of nodes, so that each rank has whole ones
    const std::size_t n_own = nodes.getMaxGlobalIndex() - nodes.getMinGlobalIndex() + 1;
    map = Teuchos::rcp(new Map(4 * n_nodes, 4 * n_own, 0, comm));
    K = Teuchos::rcp(new Matrix(map, 4 * 27));
    b = Teuchos::rcp(new MultiVector(map, 1));
    for (int cell = 0; cell < n * n * n; ++cell) add({cell % n, cell / n % n, cell / n / n});
    K->fillComplete();
  }

  Teuchos::RCP<const Map> map;
  Teuchos::RCP<Matrix> K;
  Teuchos::RCP<MultiVector> b;

private:
  using Triple = std::array<int, 3>;

  long long node(const Triple& cell, int corner) const {
    const auto at = [&](int d) { return cell[d] + (corner >> d & 1); };
    return at(0) + (n_ + 1LL) * (at(1) + (n_ + 1LL) * at(2));
  }

  bool is_fixed(long long node) const {
    const long long m = n_ + 1, y = node / m % m, z = node / m / m;
    return node % m == 0 || y == 0 || y == n_ || z == 0 || z == n_;
  }

  /// ∫ of the product of two corners' functions, differentiated da and db times by x_d: products of
  /// three integrals along a line.
  double integral(int a, int b, Triple da, Triple db) const {
    const double h = 1.0 / n_;
    double product = 1.0;
    for (int d = 0; d < 3; ++d) {
      const bool a_high = a >> d & 1, b_high = b >> d & 1;
      const double mass = h / (a_high == b_high ? 3.0 : 6.0);
      const double slope_a = (a_high ? 1.0 : -1.0), slope_b = (b_high ? 1.0 : -1.0);
      if (da[d] && db[d])
        product *= slope_a * slope_b / h;
      else
        product *= da[d] ? slope_a / 2.0 : db[d] ? slope_b / 2.0 : mass;
    }
    return product;
  }

  /// Entry of the unknowns i and j of two corners.
  double entry(int a, int i, int b, int j) const {
    const auto by = [](int d) { return Triple{d == 0, d == 1, d == 2}; };
    if (i < 3 && j < 3 && i != j) return 0.0;
    if (i < 3 && j == 3) return -integral(a, b, by(i), {});
    if (i == 3 && j < 3) return -integral(a, b, {}, by(j));
    double laplace = 0.0;
    for (int d = 0; d < 3; ++d) laplace += integral(a, b, by(d), by(d));
    return i < 3 ? laplace : -laplace / (12.0 * n_ * n_);
  }

  void add(const Triple& cell) {
    for (int a = 0; a < 8; ++a)
      for (int i = 0; i < 4; ++i) {
        const long long row = 4 * node(cell, a) + i;
        if (!map->isNodeGlobalElement(row)) continue;
        const bool is_given = i < 3 && is_fixed(row / 4);
        if (i == 0 && !is_given) b->sumIntoGlobalValue(row, 0, 0.125 / n_ / n_ / n_);
        std::vector<long long> columns;
        std::vector<double> values;
        for (int c = 0; c < 8; ++c)
          for (int j = 0; j < 4; ++j) {
            const long long column = 4 * node(cell, c) + j;
            const bool is_left_out = is_given || (j < 3 && is_fixed(column / 4));
            columns.push_back(column);
            values.push_back(is_left_out ? double(row == column) : entry(a, i, c, j));
          }
        K->insertGlobalValues(row, columns.size(), values.data(), columns.data());
      }
  }

  int n_;
};
