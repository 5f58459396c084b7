#pragma once
#include <Teuchos_ParameterList.hpp>
#include <functional>
#include <string>
#include <vector>

#include "tunica/fields/state.hpp"
#include "tunica/stepping/clock.hpp"
#include "tunica/stepping/time_scheme.hpp"

namespace tunica::problems {

class FieldProblem;
class FluidProblem;
class SolidProblem;

/// Permitted errors: see StepError.
struct StepTolerance {
  double tolerance;           ///< ε
  double displacement_scale;  ///< s of a displacement [mm]
  double velocity_scale;      ///< s of a velocity [mm/ms]
  bool is_steady_sought;  ///< what counts is how much x changes: xᵖ = xⁿ⁻¹, C = 1, permitted is ε
};
/// From a resolved "Time" list of adaptive steps or of a steady flow.
StepTolerance step_tolerance(const Teuchos::ParameterList& time);

/// How accurate the steps of a field are.
///
///   ‖C (x − xᵖ)‖ ≤ ε^((p + 1)/p) max(s, ‖x‖ at its largest),   ‖x‖² = ∫ |x|² dV/V
///
///   x    the fluid's velocity; the wall's displacement, and its velocity        mm, mm/ms
///   C, xᵖ, p   error constant, extrapolation and order of its time scheme       (time_scheme.hpp)
///
/// While the solution changes by its own size, steps with an error ε^((p + 1)/p) add up to about ε,
/// so that the error of a run is proportional to ε. Source: [Soe].
class StepError final : public fields::Restartable {
public:
  /// The field must outlive the object and stand at its start.
  StepError(FluidProblem& fluid, const StepTolerance& tolerance);
  StepError(SolidProblem& wall, const StepTolerance& tolerance);
  StepError(const StepError&) = delete;
  StepError& operator=(const StepError&) = delete;

  struct Estimate {
    double ratio = 0.0;  ///< error over what is permitted
    double eta = 0.0;    ///< by what part the step is too long: ratio^(1/(q + 1))
  };
  /// Error estimate of the step that the field has just accepted; the worst quantity. Collective.
  Estimate estimate(const stepping::Clock& clock);
  /// The step stays. Collective.
  void accept();

  // Restartable: all but the values of the last step, which are the field's and restored before
  fields::State save() const override;
  std::string restore(const fields::State& state) override;

private:
  using Values = std::vector<Vec3>;  ///< of the owned nodes

  struct Quantity {
    std::string name;
    double smallest_scale;
    std::function<Values()> now;
    std::function<stepping::ErrorFormula(const stepping::StepSizes&)> formula;
    stepping::Timeline past;  ///< of three steps, on owned nodes
    double largest = 0.0;     ///< norm up to the last step
  };

  StepError(FieldProblem& field, const stepping::TimeScheme& scheme,
            const StepTolerance& tolerance);
  void watch(const std::string& name, double smallest_scale, std::function<Values()> now,
             std::function<stepping::ErrorFormula(const stepping::StepSizes&)> formula);
  Estimate estimate(const Quantity& quantity, const stepping::StepSizes& sizes) const;
  double norm_of(const Values& values) const;

  FieldProblem* field_;
  const stepping::TimeScheme* scheme_;
  bool is_steady_sought_;
  double permitted_;  ///< ε^((p + 1)/p)
  std::vector<Quantity> quantities_;
};

}  // namespace tunica::problems
