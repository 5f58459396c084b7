#pragma once
#include <string>

#include "tunica/params/table.hpp"

namespace Teuchos {
class ParameterList;
}

namespace tunica::nonlinear {

struct NewtonReport;

/// How well each linear system of a Newton solve is to be solved: |b − Kx| ≤ η_k |b|.
struct ForcingOptions {
  std::string kind;       ///< "constant", "type 1", "type 2", "increment"
  double tolerance;       ///< η of "constant", η_1 of "type 1" and "type 2"
  double smallest = 0.0;  ///< bounds of the later η_k
  double largest = 0.0;
  double scale = 0.0;       ///< s of "increment"
  double final_part = 0.0;  ///< of "increment": see increment_forcing()
};

/// Adds the key "forcing" with the keys of each kind.
void add_forcing_keys(params::Table& table, double linear_tolerance = 1e-8);
/// list: the resolved "Newton" list.
ForcingOptions forcing_options(const Teuchos::ParameterList& list);

/// The reduction of the linear residual that the next Newton step deserves after one whose
/// increment was e = |dx_{k−1}|/|dx_1| in the mass norm (η_max in the first step):
///
///   η_k = min(η_max, max((s e)², f ε2/e, η_min))
///
/// The square keeps Newton's quadratic order. f > 0 stops it short of an accuracy that no later
/// step will ask for: with η_k = f ε2/e, and as far as error and residual fall alike, what the
/// linear solver leaves is f times the increment at which Newton's method stops. The source has
/// f = 0.
/// stop: ε2, the e at which Newton's method stops. Source: [LY1] section 6, made free of units.
double increment_forcing(const ForcingOptions& options, double e, double stop);

/// The increments at which a Newton solve stops, made or expected: the larger one counts.
struct NewtonGoal {
  double relative;  ///< to the first increment
  double absolute;
};

/// Sets the list "Direction" of NOX. report: of the solve under way, must outlive NOX's solver.
void choose_direction(const ForcingOptions& options, const NewtonGoal& goal,
                      const NewtonReport& report, Teuchos::ParameterList& nox);

}  // namespace tunica::nonlinear
