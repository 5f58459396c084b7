#include "tunica/linear/solvers/conjugate_gradients.hpp"

#include <Teuchos_BLAS.hpp>
#include <algorithm>
#include <cmath>
#include <string>

#include "tunica/base/reduce.hpp"
#include "tunica/base/stop_signals.hpp"
#include "tunica/io/progress.hpp"

namespace tunica::linear {

namespace {

using Numbers = std::vector<double>;  ///< one of each column

/// xᵀy of each column, of the rows of this rank.
Numbers local_products(const MultiVector& X, const MultiVector& Y) {
  const Teuchos::BLAS<int, double> blas;
  const auto x = X.getLocalViewHost(read_only);
  const auto y = Y.getLocalViewHost(read_only);
  const int n = static_cast<int>(x.extent(0));
  Numbers products(X.getNumVectors(), 0.0);
  if (n == 0) return products;
  for (std::size_t j = 0; j < products.size(); ++j)
    products[j] = blas.DOT(n, &x(0, j), 1, &y(0, j), 1);
  return products;
}

/// y ← a y + b x of each column.
void combine(const Numbers& a, MultiVector& Y, const Numbers& b, const MultiVector& X) {
  const auto x = X.getLocalViewHost(read_only);
  const auto y = Y.getLocalViewHost(read_write);
  for (std::size_t j = 0; j < a.size(); ++j)
    for (std::size_t i = 0; i < y.extent(0); ++i) y(i, j) = a[j] * y(i, j) + b[j] * x(i, j);
}

/// The sums over all ranks of several numbers of each column, in one message.
std::vector<Numbers> summed(const Comm& comm, const std::vector<Numbers>& mine) {
  Numbers flat;
  for (const Numbers& numbers : mine) flat.insert(flat.end(), numbers.begin(), numbers.end());
  flat = global_sum(comm, flat);
  std::vector<Numbers> sums;
  auto next = flat.begin();
  for (const Numbers& numbers : mine) {
    const auto end = next + static_cast<std::ptrdiff_t>(numbers.size());
    sums.emplace_back(next, end);
    next = end;
  }
  return sums;
}

/// The state of all columns. One whose |r| has reached its goal stays as it is: p = 0.
class CgColumns {
public:
  CgColumns(const Operator& K, const Operator& M, const Numbers& goals, MultiVector& R,
            MultiVector& X)
      : K_(K), M_(M), R_(R), X_(X), Z_(R.getMap(), goals.size()), P_(R.getMap(), goals.size()),
        W_(R.getMap(), goals.size()), squares_(goals), is_open_(goals.size(), 1),
        rz_(goals.size(), 0.0) {
    for (double& goal : squares_) goal *= goal;
  }
  bool has_open() const { return std::find(is_open_.begin(), is_open_.end(), 1) != is_open_.end(); }

  // z = M r, p = z + (rᵀz / r₋ᵀz₋) p₋; false where M is not positive
  bool turn() {
    M_.apply(R_, Z_);
    auto sums = summed(comm(), {local_products(R_, Z_), local_products(R_, R_)});
    close(sums[1]);
    Numbers of_p(squares_.size(), 0.0), of_z(squares_.size(), 0.0);
    for (std::size_t j = 0; j < of_z.size(); ++j) {
      if (!is_open_[j]) continue;
      if (!(sums[0][j] > 0.0) || !std::isfinite(sums[0][j])) return false;
      of_z[j] = 1.0;
      if (rz_[j] > 0.0) of_p[j] = sums[0][j] / rz_[j];
    }
    combine(of_p, P_, of_z, Z_);
    rz_ = std::move(sums[0]);
    rr_ = std::move(sums[1]);
    return true;
  }

  // w = K p, α = rᵀz / pᵀw, x ← x + α p, r ← r − α w; false where K is not positive
  bool step() {
    K_.apply(P_, W_);
    const auto sums = summed(comm(), {local_products(P_, W_),
                                      local_products(R_, W_),
                                      local_products(W_, W_),
                                      {is_stop_urgent() ? 1.0 : 0.0}});
    if (sums[3][0] > 0.0) stop_if_urgent(comm());
    Numbers a(squares_.size(), 0.0), minus_a(squares_.size(), 0.0), left(squares_.size(), 0.0);
    for (std::size_t j = 0; j < a.size(); ++j) {
      if (!is_open_[j]) continue;
      if (!(sums[0][j] > 0.0) || !std::isfinite(sums[0][j])) return false;
      a[j] = rz_[j] / sums[0][j];
      minus_a[j] = -a[j];
      left[j] = rr_[j] - 2.0 * a[j] * sums[1][j] + a[j] * a[j] * sums[2][j];
    }
    const Numbers ones(squares_.size(), 1.0);
    combine(ones, X_, a, P_);
    combine(ones, R_, minus_a, W_);
    close(left);
    return true;
  }

private:
  const Comm& comm() const { return *R_.getMap()->getComm(); }
  void close(const Numbers& rr) {
    for (std::size_t j = 0; j < rr.size(); ++j)
      is_open_[j] = is_open_[j] && !(rr[j] <= squares_[j]);
  }

  const Operator &K_, &M_;
  MultiVector &R_, &X_;
  MultiVector Z_, P_, W_;
  Numbers squares_;  ///< of the goals
  std::vector<char> is_open_;
  Numbers rz_, rr_;
};

}  // namespace

int conjugate_gradients(const Operator& K, const Operator& M, const std::vector<double>& goals,
                        int max_iterations, MultiVector& R, MultiVector& X) {
  CgColumns columns(K, M, goals, R, X);
  int iteration = 0;
  for (; columns.has_open() && iteration < max_iterations; ++iteration) {
    io::report_progress(
        [iteration] { return "conjugate gradients, iteration " + std::to_string(iteration); });
    if (!columns.turn() || !columns.has_open() || !columns.step()) break;
  }
  return iteration;
}

}  // namespace tunica::linear
