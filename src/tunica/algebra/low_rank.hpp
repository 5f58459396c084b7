#pragma once
#include "tunica/algebra/block_vector.hpp"

namespace tunica::algebra {

/// s w vᵀ.
struct RankOne {
  double scale = 0.0;  ///< s
  BlockVector w, v;
};

/// A sum of few such products, for what couples unknowns that no element shares:
///
///   L = W S Vᵀ = Σ_k s_k w_k v_kᵀ
class LowRank {
public:
  /// Zero.
  LowRank(const BlockSpacePtr& space, int rank);

  int rank() const { return static_cast<int>(parts_.size()); }
  const RankOne& operator[](int k) const { return parts_[k]; }
  RankOne& operator[](int k) { return parts_[k]; }

  /// y_i ← y_i + α Σ_k s_k w_k,i (v_kᵀ x) for the parts of longer vectors, all their columns. y may
  /// be x. Collective.
  void add(const std::vector<Teuchos::RCP<MultiVector>>& x,
           const std::vector<Teuchos::RCP<MultiVector>>& y, Scalar alpha) const;

private:
  std::vector<RankOne> parts_;
};

}  // namespace tunica::algebra
