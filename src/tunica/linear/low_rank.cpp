#include "tunica/linear/low_rank.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "tunica/base/reduce.hpp"
#include "tunica/smoothers/dense/dense.hpp"

namespace tunica::linear {

namespace {

/// A vector as LowRank takes it.
std::vector<Teuchos::RCP<MultiVector>> as_part(const MultiVector& x) {
  return {Teuchos::rcpFromRef(const_cast<MultiVector&>(x))};
}

double largest(const std::vector<double>& values) {
  double size = 0.0;
  for (const double value : values) size = std::max(size, std::abs(value));
  return size;
}

/// D = (I + S VᵀZ)⁻¹ S row by row, of the S in L and the products VᵀZ; empty where there is no
/// inverse to speak of.
std::vector<double> core(const algebra::LowRank& L, const std::vector<double>& VZ) {
  const int n = L.rank();
  std::vector<double> D(VZ);
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) D[i * n + j] = L[i].scale * VZ[i * n + j] + (i == j ? 1.0 : 0.0);
  const double before = largest(D);
  smoothers::DenseScratch scratch;
  if (!smoothers::invert_dense(n, D.data(), scratch)) return {};
  if (!(n * before * largest(D) < 1e14)) return {};  // its condition; also where no number
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) D[i * n + j] *= L[j].scale;
  return D;
}

}  // namespace

LowRankForm::LowRankForm(const algebra::BlockMatrix& K, const Teuchos::RCP<const Map>& map,
                         Gather gather)
    : blocks_(K.low_rank()), long_space_(std::make_shared<const algebra::BlockSpace>(
                                 std::vector<algebra::Block>{{"all", map}})),
      gather_(std::move(gather)) {}

// W, S and V of the blocks, each w and v as one long vector
algebra::LowRank LowRankForm::take() const {
  algebra::LowRank L(long_space_, blocks_->rank());
  for (int k = 0; k < L.rank(); ++k) {
    L[k].scale = (*blocks_)[k].scale;
    gather_((*blocks_)[k].w, L[k].w[0]);
    gather_((*blocks_)[k].v, L[k].v[0]);
  }
  return L;
}

// Y ← α (A + W S Vᵀ) X + β Y
void LowRankSum::apply(const MultiVector& X, MultiVector& Y, Teuchos::ETransp mode, Scalar alpha,
                       Scalar beta) const {
  if (mode != Teuchos::NO_TRANS) throw std::logic_error("LowRankSum: no transpose");
  A_->apply(X, Y, mode, alpha, beta);
  L_.add(as_part(X), as_part(Y), alpha);
}

bool LowRankInverse::refresh(const Teuchos::RCP<const Operator>& P_inverse, const Solve& solve) {
  P_inverse_ = P_inverse;
  correction_ = form_.take();
  algebra::LowRank& L = correction_;
  const int n = L.rank();
  for (int j = static_cast<int>(Z_.size()); j < n; ++j) Z_.emplace_back(L[j].w[0].getMap());
  std::vector<double> VZ(static_cast<std::size_t>(n) * n);
  for (int j = 0; j < n; ++j) {
    solve(L[j].w[0], Z_[j]);  // K z_j = w_j
    for (int i = 0; i < n; ++i) VZ[i * n + j] = L[i].v[0].dot(Z_[j]);
  }
  // Each rank computes D by itself, and all take it or none.
  const std::vector<double> D = core(L, VZ);
  const bool is_regular = all_agree(*P_inverse_->getRangeMap()->getComm(), !D.empty());
  // The correction −Z D Vᵀ keeps V and gets the columns of Z D in place of W. Without an inverse
  // its scales are zero, which leaves P⁻¹ alone.
  for (int j = 0; j < n; ++j) {
    L[j].scale = is_regular ? -1.0 : 0.0;
    L[j].w[0].putScalar(0.0);
    for (int i = 0; is_regular && i < n; ++i) L[j].w[0].update(D[i * n + j], Z_[i], 1.0);
  }
  return is_regular;
}

void LowRankInverse::set_solutions(std::vector<Vector> Z) {
  Z_ = std::move(Z);
  if (static_cast<int>(Z_.size()) != correction_.rank()) Z_.clear();  // of a case with others
}

void LowRankInverse::apply(const MultiVector& X, MultiVector& Y, Teuchos::ETransp mode,
                           Scalar alpha, Scalar beta) const {
  if (mode != Teuchos::NO_TRANS) throw std::logic_error("LowRankInverse: no transpose");
  // The correction is one of P⁻¹ x alone, without what Y held before.
  if (beta != 0.0) {
    MultiVector T(Y.getMap(), Y.getNumVectors());
    apply(X, T);
    return Y.update(alpha, T, beta);
  }
  P_inverse_->apply(X, Y, mode, alpha, 0.0);
  correction_.add(as_part(Y), as_part(Y), 1.0);  // y ← y − Z D Vᵀ y
}

}  // namespace tunica::linear
