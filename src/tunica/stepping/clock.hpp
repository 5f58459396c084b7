#pragma once
#include <Teuchos_ParameterList.hpp>
#include <array>
#include <vector>

namespace tunica::stepping {

/// Sizes of a step and of the two before it [ms]; zero where there was none.
struct StepSizes {
  double now = 0.0, last = 0.0, before = 0.0;
};

/// Steps that are missing were as long as the next.
StepSizes without_gaps(StepSizes sizes);

/// Weights of xⁿ⁻¹, xⁿ⁻², xⁿ⁻³ in the value that the polynomial through the last degree + 1 of
/// them, degree at most 2, has at the new time.
std::array<double, 3> extrapolation(int degree, const StepSizes& some);

/// Where a run stands: the step being solved. Equidistant, t^n = n Δt, unless set_step() says
/// otherwise.
class Clock {
public:
  /// steps: 0 where nobody knows how many.
  Clock(double step_size, int steps) : Clock(step_size, steps, steps * step_size) {}
  Clock(double step_size, int steps, double end);
  /// From a resolved "Time" list; equidistant, whatever its step control.
  explicit Clock(const Teuchos::ParameterList& options);

  bool is_done() const { return step_ >= steps_; }
  void advance();
  /// Goes on behind so many steps that an earlier run has made; the sizes of the last two.
  void resume_after(int steps_done, double last_size, double size_before);

  /// The step being solved counts from 1; its time is the new one [ms].
  int step() const { return step_ + 1; }
  double time() const { return time_; }
  double step_size() const { return sizes_.now; }
  /// Δt of the step before; zero where a scheme has to begin anew, as in the first step [ms].
  double previous_step_size() const { return begins_anew_ ? 0.0 : sizes_.last; }
  const StepSizes& step_sizes() const { return sizes_; }
  int steps() const { return steps_; }
  double end() const { return end_; }  ///< of the run [ms]

  /// Counter for "every so many steps": the number of the step, zero within a step that was cut.
  int count() const { return count_; }
  bool is_every(int steps) const { return count_ > 0 && count_ % steps == 0; }
  bool is_last() const { return is_last_; }
  /// Somebody has asked for the fields at its end.
  bool is_asked_for() const { return is_asked_for_; }

  /// The end of a step as a step control wants it.
  struct Plan {
    double time, step_size;
    int count;
    bool is_last, is_asked_for, begins_anew;
  };
  /// Replaces the present step, which is not yet made.
  void set_step(const Plan& plan);
  /// The present step is the last one after all.
  void end_here() { is_last_ = true; }

private:
  void set_equidistant_step();

  double nominal_size_;
  int steps_;
  double end_;
  int step_ = 0;
  double time_ = 0.0;
  StepSizes sizes_;
  int count_ = 1;
  bool is_last_ = false, is_asked_for_ = false, begins_anew_ = false;
};

}  // namespace tunica::stepping
