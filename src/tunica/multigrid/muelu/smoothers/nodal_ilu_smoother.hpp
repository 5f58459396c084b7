#pragma once
#include <memory>
#include <vector>

#include "tunica/multigrid/muelu/smoothers/matrix_smoother.hpp"
#include "tunica/multigrid/muelu/smoothers/smoother_state.hpp"
#include "tunica/smoothers/node_ilu/node_ilu.hpp"

namespace tunica::multigrid {

/// "NodalIluSmoother" of a MueLu list, for mixed matrices: x += ω w_k (L U)⁻¹ (b − K x) in sweep k,
/// with the factors of NodeIlu. Its keys: "sweeps" (1), "polynomial" ("power", "chebyshev"),
/// "damping" (1.0), "fill" (0), "most fill" (2), "spectral bound" (1.6), "flat bound" (1.3),
/// "precision" ("half", "single", "double").
///
/// n sweeps take e to Π_k (1 − ω w_k (L U)⁻¹ K) e. With "power" all w_k are 1. With "chebyshev"
/// they are the reciprocals of the zeros of Chebyshev's polynomial of degree n on [0.55, 1.25],
/// where the eigenvalues of errors are that no coarser level sees [Sa03, 12.3]. Three sweeps reach
/// an absolute value of 1 at 1.8 only, which "spectral bound" keeps away from.
///
/// Where stiffness outweighs inertia and elements are flat or irregular, factors without fill
/// overshoot: the spectral radius ρ of (L U)⁻¹ K exceeds 2, and sweeps diverge. ρ is measured by
/// power iterations, at the first set-up until it stands still. Where it is above "spectral bound"
/// the diagonal blocks of what is factorised are enlarged by a few per cent, then fill is added, up
/// to "most fill"; the first such factors within the bound are kept, or those of the smallest ρ. ω
/// is the lesser of "damping" and the bound over ρ. With "spectral bound" 0 nothing is measured.
/// Where the elements of solids are very flat (flatness_of_solids), "flat bound" is the bound if it
/// is smaller: there fill saves iterations below "spectral bound", too.
class NodalIluSmoother : public MixedSmoother {
public:
  Teuchos::RCP<const Teuchos::ParameterList> GetValidParameterList() const override;
  Teuchos::RCP<MueLu::SmootherPrototype<Scalar, LocalOrdinal, GlobalOrdinal, Node>> Copy()
      const override;
  std::size_t getNodeSmootherComplexity() const override;
  void refresh() override;
  const SmootherState& state() const { return state_; }

  /// What earlier set-ups have taught, for a checkpoint: the attempt that serves, and when the
  /// first one is tried again.
  struct Memory {
    int attempt;
    int refreshes, patience;  ///< since the first attempt was left, and until it is taken up
  };
  const Memory& memory() const { return memory_; }
  static bool is_fresh(const Memory& memory);
  /// The next refresh() goes on from there. What no smoother has learnt is left aside.
  void recall(const Memory& memory);

private:
  void check(const Teuchos::ParameterList& list) const override;
  void set_up(const ::tunica::CrsMatrix& K, const algebra::DofLayout& numbering) override;
  void offer_residuals(LevelMatrix& matrix) const override;
  void smooth(const ::tunica::MultiVector& b, ::tunica::MultiVector& x) const override;
  /// Without a product with K in the first sweep.
  void smooth_from_zero(const ::tunica::MultiVector& b, ::tunica::MultiVector& x) const override;

  /// Factors by one of the attempts, for the present values.
  void factorise(int attempt);
  /// The further attempts, as long as ρ is above the bound; keeps the best.
  void search();
  /// ρ, from the direction where the last measurement ended.
  void measure();
  double power_iteration();
  std::vector<double> dampings() const;  ///< ω w_k

  const ::tunica::CrsMatrix* K_ = nullptr;
  algebra::DofLayout numbering_;
  double bound_ = 0.0;  ///< of ρ
  Memory memory_{};
  std::shared_ptr<smoothers::NodeIlu> factors_;
  std::shared_ptr<::tunica::MultiVector> direction_;  ///< of the largest eigenvalue
  SmootherState state_;
  std::vector<double> weights_;  ///< w_k
  smoothers::Precision precision_ = smoothers::Precision::half;
};

}  // namespace tunica::multigrid
