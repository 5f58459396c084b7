#include "tunica/stepping/clock.hpp"

#include <limits>

namespace tunica::stepping {

namespace {

int steps_of(const Teuchos::ParameterList& options) {
  const int steps = options.get<int>("steps");
  return steps > 0 ? steps : std::numeric_limits<int>::max();
}

}  // namespace

StepSizes without_gaps(StepSizes sizes) {
  if (sizes.last == 0.0) sizes.last = sizes.now;
  if (sizes.before == 0.0) sizes.before = sizes.last;
  return sizes;
}

std::array<double, 3> extrapolation(int degree, const StepSizes& some) {
  const StepSizes sizes = without_gaps(some);
  // In units of the last step, so that equal steps give whole numbers: the values lie at 0, −1,
  // −1 − b, the new one at a.
  const double a = sizes.now / sizes.last, b = sizes.before / sizes.last;
  if (degree == 0) return {1.0, 0.0, 0.0};
  if (degree == 1) return {1.0 + a, -a, 0.0};
  return {(a + 1.0) * (a + 1.0 + b) / (1.0 + b), -a * (a + 1.0 + b) / b,
          a * (a + 1.0) / ((1.0 + b) * b)};
}

Clock::Clock(double step_size, int steps, double end)
    : nominal_size_(step_size), steps_(steps), end_(end) {
  set_equidistant_step();
}

Clock::Clock(const Teuchos::ParameterList& options)
    : Clock(options.get<double>("step size"), steps_of(options)) {}

void Clock::set_equidistant_step() {
  sizes_.now = nominal_size_;
  time_ = step() * nominal_size_;
  count_ = step();
  is_last_ = step() == steps_;
  is_asked_for_ = begins_anew_ = false;
}

void Clock::advance() {
  ++step_;
  sizes_.before = sizes_.last;
  sizes_.last = sizes_.now;
  set_equidistant_step();
}

void Clock::resume_after(int steps_done, double last_size, double size_before) {
  step_ = steps_done;
  sizes_.last = last_size;
  sizes_.before = size_before;
  set_equidistant_step();
}

void Clock::set_step(const Plan& plan) {
  time_ = plan.time;
  sizes_.now = plan.step_size;
  count_ = plan.count;
  is_last_ = plan.is_last;
  is_asked_for_ = plan.is_asked_for;
  begins_anew_ = plan.begins_anew;
}

}  // namespace tunica::stepping
