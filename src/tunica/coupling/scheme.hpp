#pragma once
#include <cmath>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "tunica/base/outcome.hpp"
#include "tunica/fields/state.hpp"
#include "tunica/nonlinear/newton.hpp"
#include "tunica/params/table.hpp"
#include "tunica/problems/watched_solver.hpp"
#include "tunica/stepping/clock.hpp"

namespace tunica::coupling {

/// One nonlinear solve of a coupling iteration.
struct FieldSolve {
  std::string field;  ///< "fluid", "wall"; "system" for both in one
  nonlinear::NewtonReport report;
};

/// How long one part of a coupling iteration took.
struct Stage {
  std::string name;  ///< "motion", "fluid", "wall", "update"
  double seconds = 0.0;
};

/// One coupling iteration of a scheme. Its fields and stages are those the scheme names, in their
/// order.
struct Iteration {
  double residual = std::nan("");  ///< |r|/√n [mm]; not a number where a field failed
  double relaxation = 0.0;
  int columns = 0;
  std::vector<FieldSolve> solves;
  std::vector<Stage> stages;

  /// Throw std::out_of_range for a name that the scheme does not have.
  nonlinear::NewtonReport& solve(const std::string& field);
  const nonlinear::NewtonReport& solve(const std::string& field) const;
  double& seconds(const std::string& stage);
};

/// Outcome of a time step.
struct Report {
  bool is_converged = false;
  bool is_accepted = false;  ///< converged, or not and accepted as the options say
  std::string reason;        ///< why not
  std::string remark;        ///< on what it went on in spite of; told once in a run
  std::vector<Iteration> iterations;

  int newton_steps(const std::string& field) const;
  int linear_iterations(const std::string& field) const;
};

/// The key by which a case says what becomes of a step that has not converged, and its decision.
void add_acceptance_key(params::Table& table);
bool accepts_unconverged(const Teuchos::ParameterList& coupling);

/// A coupling scheme: it solves the time steps of coupled fields and declares the contents of its
/// reports. Its state has its name in XML as the text "scheme".
class Scheme : public fields::Restartable {
public:
  /// Called after every coupling iteration with its number, counted from 1.
  using Watch = std::function<void(int, const Iteration&)>;

  /// Names of the fields that it solves for by Newton's method, and of the stages that it times.
  virtual std::vector<std::string> fields() const = 0;
  virtual std::vector<std::string> stages() const = 0;

  /// Whose linear systems it has solved: by the names of fields().
  virtual std::vector<std::pair<std::string, problems::SystemSource*>> systems() = 0;

  /// watch is called with the name of the field and each step of Newton's method once it is made.
  using NewtonWatch = std::function<void(const std::string& field, const nonlinear::NewtonStep&)>;
  virtual void watch_newton(const NewtonWatch& watch) = 0;

  /// Begins the clock's present step, once before each solve of it. Fails, and says why, where that
  /// cannot be done. Collective.
  Outcome begin_step(const stepping::Clock& clock);
  /// Solves the step and accepts it as far as the options allow. Throws std::logic_error where
  /// begin_step() has not begun it, or it was solved since. Collective.
  Report solve_step(const stepping::Clock& clock, const Watch& watch);

protected:
  virtual Outcome begin(const stepping::Clock& clock) = 0;
  virtual Report solve(const stepping::Clock& clock, const Watch& watch) = 0;

  /// An iteration with the names of this scheme.
  Iteration new_iteration() const;

private:
  int begun_ = -1;  ///< number of the step that may be solved now
};

}  // namespace tunica::coupling
