#include "tunica/coupling/geometry_rule.hpp"

#include <algorithm>

namespace tunica::coupling {

namespace {

constexpr int longest_wait = 64, steps_of_trial = 2;
constexpr int wait_after_failure = 32;  // an attempt for nothing costs as much as many steps
/// Derivatives must need less than this part of the work; the way without them sends fewer messages
/// and needs less memory, and is taken where it needs no more.
constexpr double gain = 0.9;

// Measured on a tube of 39,000 and of 312,000 tetrahedra, in iterations without derivatives.
constexpr double of_newton_step = 1.0;   ///< c: residuals, mesh motion
constexpr double of_derivatives = 0.25;  ///< s: a mesh motion, a product with the shape matrix
constexpr double of_shape_matrix = 2.0;  ///< a: its assembly, for most steps once

// W = c n + (1 + s) Σ_k m_k + a
double work_of(const nonlinear::NewtonReport& report, bool has_derivatives) {
  const double n = static_cast<double>(report.steps.size());
  const double m = report.linear_iterations();
  if (!has_derivatives) return of_newton_step * n + m;
  return of_newton_step * n + (1.0 + of_derivatives) * m + of_shape_matrix;
}

}  // namespace

// A way begins anew, for so many steps until the other one is tried.
void GeometryRule::go(bool has_derivatives, int wait) {
  present_ = has_derivatives;
  wait_ = std::min(wait, longest_wait);
  steps_ = 0;
}

void GeometryRule::note(const nonlinear::NewtonReport& report, bool has_gone_over) {
  before_ = last_;
  last_ = work_of(report, wants_derivatives() || has_gone_over);
  ++steps_;
  // A trial without derivatives has needed them: it is over. On the way without them their trial
  // begins at once, against twice the work of this step.
  if (has_gone_over && steps_ > wait_) return note_failure();
  if (has_gone_over) {
    before_ = last_;
    steps_ = wait_;
  }
  // W of two trial steps against that of the two steps before
  if (steps_ == wait_) rival_ = before_ + last_;
  if (steps_ < wait_ + steps_of_trial) return;
  if (before_ + last_ < (present_ ? 1.0 : gain) * rival_)
    go(!present_, first_wait);
  else
    go(present_, 2 * wait_);
}

// A trial that fails ends, and the next one is far off; a way without derivatives that fails is
// left for theirs.
void GeometryRule::note_failure() {
  if (is_trial()) return go(present_, std::max(2 * wait_, wait_after_failure));
  if (!present_) go(true, wait_after_failure);
}

void GeometryRule::save(fields::State& state) const {
  state.numbers["geometry"] = {present_ ? 1.0 : 0.0,
                               static_cast<double>(wait_),
                               static_cast<double>(steps_),
                               rival_,
                               before_,
                               last_};
}

void GeometryRule::restore(const fields::State& state) {
  const auto& numbers = state.number_list("geometry");
  present_ = numbers.at(0) != 0.0;
  wait_ = static_cast<int>(numbers.at(1));
  steps_ = static_cast<int>(numbers.at(2));
  rival_ = numbers.at(3);
  before_ = numbers.at(4);
  last_ = numbers.at(5);
}

}  // namespace tunica::coupling
