#pragma once
#include <limits>
#include <vector>

#include "tunica/compare/linear_system.hpp"
#include "tunica/foreign/default_settings.hpp"
#include "tunica/foreign/residuals.hpp"
#include "tunica/linear/linear_solver.hpp"

namespace tunica::compare {

using foreign::Residuals;
using foreign::SolverSetting;

/// Result of a setting on a system.
struct SolverRow {
  std::string field;
  int newton_step = 0;
  std::string setting, method, preconditioner;
  long long unknowns = 0;
  /// Here setup_seconds is all that is not iteration: matrices made and copied, factors.
  linear::SolveReport solve;
  Residuals residuals{};              ///< of the solution; without fields where there is none
  std::vector<std::string> fields{};  ///< names of the blocks, in the order of residuals
  bool is_at_rounding = false;        ///< converged as nearly as double precision allows
  double refresh_seconds = 0.0;       ///< to set up once more, as for new values on the same graphs
  /// Seconds of processors for the set-up and for the solve with its checks, of all ranks together.
  double setup_processor_seconds = 0.0, solve_processor_seconds = 0.0;
  double memory_megabytes = 0.0;  ///< what the solver holds after the solve, on all ranks
  double difference = std::numeric_limits<double>::quiet_NaN();  ///< see SolverTable
  /// "converged"; "cap" on the iterations; "stagnated" before it; "drifted": small by the
  /// recurrence, not in truth; "diverged"; "breakdown"; or what an exception said.
  std::string verdict;

  /// Mean factor by which an iteration reduced the true residual.
  double convergence_factor() const;
  double seconds() const { return solve.setup_seconds + solve.solve_seconds; }
};

/// Sets a solver up anew and solves from zero to the tolerance; times are those of the slowest
/// rank. A system of another program, which is solved once and for all, is judged field by field
/// as its program gives it, and refined where a method takes for solved what is not. Exceptions of the
/// solver become a verdict; system errors are passed on. Collective.
SolverRow run_setting(const SolverSetting& setting, const LinearSystem& system, double tolerance,
                      algebra::BlockVector& x);

/// |x − y| / |y|, the larger one of the two blocks.
double relative_difference(const algebra::BlockVector& x, const algebra::BlockVector& y);

}  // namespace tunica::compare
