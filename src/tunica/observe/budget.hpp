#pragma once
#include <optional>

#include "tunica/params/table.hpp"
#include "tunica/problems/fluid_problem.hpp"
#include "tunica/problems/solid_problem.hpp"

namespace tunica::observe {

/// Which budget a run keeps, and what its verdicts permit.
struct BudgetSettings {
  bool is_wanted = false;
  double solver_bound = 0.0;  ///< of what the equations have left, in parts of the whole
  double scheme_bound = 0.0;  ///< of what the discretisation makes of the balances
};
/// Adds the keys of an "Output" list, and their values in a resolved one.
void add_budget_keys(params::Table& table);
BudgetSettings budget_settings(const Teuchos::ParameterList& output);

/// A total of the run and what is said of it.
struct Verdict {
  std::string of;        ///< "mass"
  std::string sentence;  ///< "solvers lost or gained 3e-12 of 6.9 mm^3 that flowed"
  double amount, whole;
  double part;  ///< amount over whole
  double bound;
  bool is_of_solver;  ///< else of the discretisation

  bool is_kept() const { return part <= bound; }
};
/// "mass: solvers lost or gained … that flowed: 4.3e-13, within 1e-06"
std::string text_of(const Verdict& verdict);

/// What the steps of a run make of mass, momentum, energy and volume: a row of budget.csv per step,
/// and totals. The state is all that has been summed, so that a run that goes on has the same
/// totals.
class Budget final : public fields::Restartable {
public:
  /// fluid, wall: null where the run has none; they keep their balances from now on.
  /// starts_at_rest: all that is stored is zero before the first step; else the budget begins at
  /// the end of the first one. has_energy: the steps are times, at which the wall moves.
  Budget(const BudgetSettings& settings, problems::FluidProblem* fluid,
         problems::SolidProblem* wall, bool starts_at_rest, bool has_energy);

  /// The row of a step that was accepted. observed: the fields' columns of steps.csv. Collective.
  discretisation::Observables add(double step_size, bool is_converged,
                                  const discretisation::Observables& observed);
  /// Of all steps so far, each with its bound.
  std::vector<Verdict> verdicts() const;
  /// Where its energy has gone, term by term, positive where it comes in [kPa mm³].
  discretisation::Observables energies() const;

  // Restartable
  fields::State save() const override;
  std::string restore(const fields::State& state) override;
  bool may_be_missing() const override { return true; }

private:
  using Numbers = std::map<std::string, double>;

  void sum_over_ranks();
  void add_mass();
  void add_forces();
  void add_energy(const discretisation::Observables& observed);
  void add_wall(const discretisation::Observables& observed);
  void add_verdicts_of_flow(std::vector<Verdict>& all) const;
  void add_verdicts_of_forces(std::vector<Verdict>& all) const;
  void add_verdicts_of_energy(std::vector<Verdict>& all) const;
  void add_verdicts_of_wall(std::vector<Verdict>& all) const;
  /// A column whose value is that of the end of the step, or its mean over the step.
  void instant(const std::string& column, double value);
  void mean(const std::string& column, double value);
  /// Mean over the step of what is known at its ends. The first one is of implicit Euler, for which
  /// its end counts.
  double over_step(const std::string& name, double now);
  /// Δx/Δt of what is stored.
  double change(const std::string& name, double now);
  void worst(const std::string& name, double value);
  double total(const std::string& column) const { return at(totals_, column); }
  /// Of the step in totals.
  double weight() const;
  double size(const std::string& column) const { return at(sizes_, column); }
  static double at(const Numbers& numbers, const std::string& name);

  BudgetSettings settings_;
  problems::FluidProblem* fluid_;
  problems::SolidProblem* wall_;
  bool has_energy_, has_trapezoids_;
  discretisation::Balance of_fluid_, of_wall_;  ///< of all ranks, of the last step

  bool has_begun_;  ///< what was before the step is known
  double step_size_ = 0.0;
  discretisation::Observables row_;
  Numbers before_;  ///< what was stored, and instants, at the end of the last step
  Numbers totals_, sizes_,
      worst_;  ///< sums over time of columns and of their sizes; largest values
};

}  // namespace tunica::observe
