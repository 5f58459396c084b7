#pragma once
#include <Teuchos_ParameterList.hpp>
#include <memory>

#include "tunica/multigrid/coarsening/mixed_coarsening.hpp"
#include "tunica/multigrid/muelu/smoothers/smoother_state.hpp"

namespace tunica::multigrid {

class NodalIluSmoother;

/// The matrices of a hierarchy, the finest first.
struct Levels {
  std::vector<long long> unknowns;         ///< of all ranks
  double operator_complexity = 0.0;        ///< entries of all levels to those of the finest
  std::vector<SmootherState> smoothers{};  ///< of the levels that have a NodalIluSmoother
  bool is_w_cycle = false;                 ///< by the cycle's own choice
};

/// One multigrid cycle as an operator, by a MueLu list in the form of factories and a hierarchy.
/// apply() starts from zero, honours alpha and beta and takes any number of columns.
///
/// Without a "cycle type" in the list's "Hierarchy" there are W cycles on deep hierarchies, unless
/// "W cycles on deep levels" (true) is false there, and on those of solids with flat elements.
class Cycle : public Operator {
public:
  static constexpr const char* w_cycles = "W cycles on deep levels";  ///< key of "Hierarchy"

  /// Throws std::exception for a list that MueLu refuses, and for a singular coarsest matrix.
  /// Collective.
  Cycle(const Teuchos::RCP<CrsMatrix>& A, const Teuchos::RCP<MixedCoarsening>& coarsening,
        const Teuchos::ParameterList& muelu, bool is_blocked = false);
  /// For a mixed matrix that any program has assembled, with vectors of so many components: its
  /// unknowns are numbered (components + 1) * node + i, the scalar last, and those of a node are on
  /// one rank. The coarse nodes come from its graph. An operator for Belos, as in
  /// examples/smoothers/:
  ///
  ///   Teuchos::getParametersFromXmlFile("vanka.xml") names VankaSmoother, NodalIluSmoother, ...
  ///   const auto M = Teuchos::rcp(new multigrid::Cycle(K, 3, *list));
  ///   problem.setRightPrec(M);
  ///
  /// Throws as the other, and tunica::Error for other numbers (see nodes_of()). Collective.
  Cycle(const Teuchos::RCP<CrsMatrix>& A, int components, const Teuchos::ParameterList& muelu);
  ~Cycle() override;

  /// Follows new values of the same matrix. Numeric work only where "NodalPFactory" and
  /// "GalerkinFactory" made all levels and the smoothers and the coarse solver are ours; otherwise
  /// all anew. Throws as the constructor. Collective.
  void refresh();
  /// True where refresh() finds no graphs again.
  bool keeps_graphs() const;

  /// What a solve with the cycle has taken, and the part of the residual that it has left. Where
  /// "NodalPFactory" waits for it ("rotations from"), cycles that contract badly interpolate
  /// rotations from the next refresh() on, which then finds the levels anew: true where it is to.
  bool note(int iterations, double reduction);
  /// Whether it has none, and may want them.
  bool may_take_rotations() const { return rotations_from_ > 0.0 && !has_rotations_; }

  /// What the cycle and its smoothers have learnt over set-ups and a new cycle would not know, as
  /// numbers for a checkpoint; empty where they have learnt nothing. With it the set-ups of a new
  /// cycle go on as those of this one would: recall(), then refresh(). Numbers of another hierarchy
  /// are left aside. recall() is collective.
  std::vector<double> memory() const;
  void recall(const std::vector<double>& memory);

  const Levels& levels() const;
  /// The matrix of a level, 0 the finest.
  Teuchos::RCP<const CrsMatrix> matrix(int level) const;

  void apply(const MultiVector& X, MultiVector& Y, Teuchos::ETransp mode = Teuchos::NO_TRANS,
             Scalar alpha = 1.0, Scalar beta = 0.0) const override;
  Teuchos::RCP<const Map> getDomainMap() const override { return A_->getRangeMap(); }
  Teuchos::RCP<const Map> getRangeMap() const override { return A_->getDomainMap(); }

private:
  struct Parts;

  void set_up();
  void choose_cycle_type();
  Teuchos::ParameterList present_list() const;
  Levels count_levels() const;
  std::vector<NodalIluSmoother*> ilu_smoothers() const;
  std::vector<SmootherState> smoother_states() const;
  void iterate(const MultiVector& b, MultiVector& x) const;

  Teuchos::RCP<CrsMatrix> A_;
  Teuchos::RCP<MixedCoarsening> coarsening_;
  Teuchos::ParameterList muelu_;
  bool is_blocked_;
  std::unique_ptr<Parts> parts_;
  double rotations_from_;  ///< contraction; 0: the list says whether there are any
  bool wants_rotations_ = false, has_rotations_ = false;  ///< where that is not 0
  int iterations_ = 0;                                    ///< since the last set-up
  double logarithm_ = 0.0;                                ///< of what they have left of residuals
};

/// Builds the factories of such a list without a matrix. Throws tunica::Error for what MueLu
/// refuses or what wants the other kind of matrix; for an unknown factory with the names that are
/// ours.
void check_cycle_list(const Teuchos::ParameterList& muelu, bool is_blocked = false);

/// Cycles on the levels of the nodal coarsening with sweeps of symmetric Gauss-Seidel before and
/// after, sparse LU at the coarsest level of at most coarse_size unknowns. has_w_cycles: on deep
/// levels, see Cycle.
Teuchos::ParameterList nodal_cycle_list(int sweeps, int coarse_size, bool has_w_cycles = true);

/// The default list for a mixed system, smoothed by incomplete factors in node blocks. polynomial:
/// as NodalIluSmoother has it; rotations_from: as NodalPFactory; has_w_cycles: as above.
Teuchos::ParameterList mixed_cycle_list(int sweeps, const std::string& polynomial = "power",
                                        double rotations_from = 0.0, bool has_w_cycles = true);

/// A list for a mixed system, smoothed by Braess and Sarazin's sweeps with so many of Gauss-Seidel
/// for the Schur complement, which requires no C and no order of the nodes. Coarse levels get a C
/// (SchurStabilised).
Teuchos::ParameterList braess_sarazin_cycle_list(int sweeps, int schur_sweeps);

/// A list for a mixed system, smoothed by Vanka's sweeps over pairs of nodes (smoothers/vanka/),
/// which cost more and are more robust than incomplete factors.
Teuchos::ParameterList vanka_cycle_list(int sweeps);

}  // namespace tunica::multigrid
