#pragma once
#include <memory>
#include <vector>

#include "tunica/multigrid/muelu/smoothers/mixed_smoother.hpp"
#include "tunica/smoothers/node_ilu/node_ilu.hpp"

namespace tunica::multigrid {

/// "NodalIluSmoother" of a MueLu list, for mixed matrices: x += ω w_k (L U)⁻¹ (b − K x) in sweep k,
/// with the factors of NodeIlu. Its keys: "sweeps" (1), "polynomial" ("power", "chebyshev"),
/// "damping" (1.0), "fill" (0), "most fill" (2), "spectral bound" (1.6), "precision" ("single",
/// "double").
///
/// n sweeps take e to Π_k (1 − ω w_k (L U)⁻¹ K) e. With "power" all w_k are 1. With "chebyshev"
/// they are the reciprocals of the zeros of Chebyshev's polynomial of degree n on [0.55, 1.25],
/// where the eigenvalues of errors are that no coarser level sees [Sa03, 12.3]. Three sweeps reach
/// an absolute value of 1 at 1.8 only, which "spectral bound" keeps away from.
///
/// Where stiffness outweighs inertia and elements are irregular, factors without fill overshoot:
/// the spectral radius ρ of (L U)⁻¹ K exceeds 2, and sweeps diverge. ρ is estimated by power
/// iterations at each set-up. As long as it is above "spectral bound" fill is added, up to "most
/// fill"; ω is the lesser of "damping" and "spectral bound"/ρ. With "spectral bound" 0 nothing is
/// estimated.
class NodalIluSmoother : public MixedSmoother {
public:
  Teuchos::RCP<const Teuchos::ParameterList> GetValidParameterList() const override;
  Teuchos::RCP<MueLu::SmootherPrototype<Scalar, LocalOrdinal, GlobalOrdinal, Node>> Copy()
      const override;
  std::size_t getNodeSmootherComplexity() const override;
  void refresh() override;

private:
  void check(const Teuchos::ParameterList& list) const override;
  void set_up(const ::tunica::CrsMatrix& K, const algebra::DofLayout& numbering) override;
  void smooth(const ::tunica::MultiVector& b, ::tunica::MultiVector& x) const override;
  /// Without a product with K in the first sweep.
  void smooth_from_zero(const ::tunica::MultiVector& b, ::tunica::MultiVector& x) const override;

  void make_factors();
  /// Of (L U)⁻¹ K; begins where the last estimate ended.
  double spectral_radius(int iterations);

  const ::tunica::CrsMatrix* K_ = nullptr;
  algebra::DofLayout numbering_;
  int fill_ = 0;
  int refreshes_ = 0, patience_ = 0;  ///< since there is more fill than asked for, and its length
  std::shared_ptr<smoothers::NodeIlu> factors_;
  std::shared_ptr<::tunica::MultiVector> direction_;  ///< of the largest eigenvalue
  double damping_ = 1.0;                              ///< ω
  std::vector<double> weights_;                       ///< w_k
};

}  // namespace tunica::multigrid
