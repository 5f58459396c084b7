#pragma once
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "tunica/base/outcome.hpp"
#include "tunica/foreign/default_settings.hpp"
#include "tunica/foreign/given_operators.hpp"
#include "tunica/foreign/residuals.hpp"

namespace tunica::foreign {

/// What a solve has come to.
struct Answer {
  linear::SolveReport report;
  Residuals residuals;
  std::string setting;   ///< that found the nearest solution
  std::string failures;  ///< of settings tried before, each in a line
};

/// Solves with the matrix of another program again and again: with the first of its settings that
/// converges, from the one on that did so last.
class SystemSolver {
public:
  /// solvers: a resolved list of settings; without any, those that the matrix asks for. The system
  /// must outlive it. Collective, as all others.
  SystemSolver(const systems::System& system, const Teuchos::ParameterList& solvers);

  /// Sets up the first setting that can be; throws Error where none can.
  void set_up();
  /// Follows new values of the same matrix by numeric work.
  void refresh();
  /// y of K y = b of the system, the nearest one where no setting has converged.
  Answer solve(algebra::BlockVector& y);

  const SolverSetting& setting() const { return settings_[present_]; }
  double tolerance() const { return tolerance_; }

private:
  /// From the present one on; false where there is none.
  bool prepare_next();
  /// Why, in the terms of the user.
  std::string told(const Outcome& failure) const;

  const systems::System* system_;
  GivenOperators operators_;
  double tolerance_;
  std::vector<SolverSetting> settings_;
  std::size_t present_ = 0;
  bool has_been_slow_ = false;  ///< a setting has been given up before its end
  std::unique_ptr<linear::LinearSolver> solver_;
  std::string failures_;
};

}  // namespace tunica::foreign
