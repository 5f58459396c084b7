#include "tunica/algebra/least_squares.hpp"

#include <Teuchos_CommHelpers.hpp>
#include <cmath>

namespace tunica::algebra {

namespace {

/// Inner products of v with every vector of the basis, in one reduction.
std::vector<double> products(const Comm& comm, const std::vector<std::vector<double>>& basis,
                             const std::vector<double>& v) {
  std::vector<double> mine(basis.size(), 0.0), sum(basis.size(), 0.0);
  for (std::size_t j = 0; j < basis.size(); ++j)
    for (std::size_t i = 0; i < v.size(); ++i) mine[j] += basis[j][i] * v[i];
  if (!basis.empty())
    Teuchos::reduceAll(comm, Teuchos::REDUCE_SUM, static_cast<int>(mine.size()), mine.data(),
                       sum.data());
  return sum;
}

double length_of(const Comm& comm, const std::vector<double>& v) {
  return std::sqrt(products(comm, {v}, v)[0]);
}

}  // namespace

LeastSquares solve_least_squares(const Comm& comm, const std::deque<std::vector<double>>& columns,
                                 const std::vector<double>& b, double filter) {
  LeastSquares result{std::vector<double>(columns.size(), 0.0),
                      std::vector<char>(columns.size(), 0)};
  std::vector<std::vector<double>> Q;
  std::vector<std::vector<double>> R;  // columns of the triangle
  std::vector<std::size_t> kept;
  for (std::size_t j = 0; j < columns.size(); ++j) {
    std::vector<double> q = columns[j];
    std::vector<double> r(Q.size(), 0.0);
    const double length = length_of(comm, q);
    for (int pass = 0; pass < 2; ++pass) {  // q ← (I − Q Qᵀ) v, twice against round-off
      const std::vector<double> along = products(comm, Q, q);
      for (std::size_t k = 0; k < Q.size(); ++k) {
        r[k] += along[k];
        for (std::size_t i = 0; i < q.size(); ++i) q[i] -= along[k] * Q[k][i];
      }
    }
    const double rest = length_of(comm, q);
    if (!(rest > filter * length)) continue;
    for (double& value : q) value /= rest;
    r.push_back(rest);
    R.push_back(r);
    Q.push_back(q);
    kept.push_back(j);
    result.is_kept[j] = 1;
  }
  std::vector<double> c = products(comm, Q, b);  // R c = Qᵀ b, from the last row up
  for (std::size_t k = Q.size(); k-- > 0;) {
    for (std::size_t l = k + 1; l < Q.size(); ++l) c[k] -= R[l][k] * c[l];
    c[k] /= R[k][k];
    result.coefficients[kept[k]] = c[k];
  }
  return result;
}

}  // namespace tunica::algebra
