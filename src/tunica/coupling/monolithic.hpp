#pragma once
#include <optional>

#include "tunica/coupling/geometry_rule.hpp"
#include "tunica/coupling/scheme.hpp"
#include "tunica/problems/coupled_problem.hpp"
#include "tunica/problems/state_history.hpp"

namespace tunica::coupling {

params::Table monolithic_table();
/// The keys of its "Linear Solver". By default a multigrid cycle with incomplete factors in node
/// blocks, as for the wall.
params::Table monolithic_solver_table();

/// A resolved "Coupling" list of this scheme.
struct MonolithicSettings {
  MonolithicSettings(const Teuchos::ParameterList& list);  // NOLINT: a list is what is not decoded

  problems::CoupledSettings problem;
  int predictor_order;
  bool accepts_unconverged;  ///< go on with a warning where a step does not converge
};

/// One Newton's method for fluid and wall together (problems/coupled_problem.hpp), started from
/// what the steps before let expect. A step is one coupling iteration, whose residual is the last
/// Newton increment [mm], and a second, more careful one where the first has failed.
class Monolithic final : public Scheme {
public:
  /// The problems must outlive the object.
  Monolithic(const MonolithicSettings& settings, const problems::CoupledProblem::Parts& parts);

  static constexpr const char* scheme_name = "monolithic";

  // Scheme
  std::vector<std::string> fields() const override { return {"system"}; }
  std::vector<std::string> stages() const override {
    return {"motion", "fluid", "wall", "matrix", "system"};
  }
  std::vector<std::pair<std::string, problems::SystemSource*>> systems() override {
    return {{"system", &problem_}};
  }
  void watch_newton(const NewtonWatch& watch) override;

  // Restartable: the states that a step is guessed from belong to its parts
  fields::State save() const override;
  std::string restore(const fields::State& state) override;
  std::map<std::string, fields::Restartable*> inner_parts() override {
    return {{"fluid states", &fluid_states_}, {"wall states", &wall_states_}};
  }

private:
  // Scheme
  Outcome begin(const stepping::Clock& clock) override;
  Report solve(const stepping::Clock& clock, const Watch& watch) override;

  /// Finds the fields at the end of the step and accepts them. Fails where that cannot be done;
  /// over: there were such fields, and no further attempt will do.
  Outcome attempt(bool is_careful, const stepping::Clock& clock, Iteration& iteration,
                  bool& is_over);

  problems::CoupledProblem problem_;
  bool accepts_unconverged_;
  std::optional<GeometryRule> rule_;  ///< where the geometry is "automatic"
  int step_ = 0, failed_step_ = -1;   ///< the last one, and the last whose first attempt failed
  int predictor_order_;
  problems::FluidProblem* fluid_;
  problems::SolidProblem* wall_;
  problems::MeshMotion* motion_;
  problems::StateHistory fluid_states_, wall_states_;
};

}  // namespace tunica::coupling
