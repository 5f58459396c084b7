#pragma once
#include "tunica/params/table.hpp"

namespace tunica::stepping {

/// Equidistant time steps t^n = n Δt.
class Clock {
public:
  Clock(double step_size, int steps) : step_size_(step_size), steps_(steps) {}
  /// From a resolved "Time" list.
  explicit Clock(const Teuchos::ParameterList& options)
      : Clock(options.get<double>("step size"), options.get<int>("steps")) {}

  bool is_done() const { return step_ >= steps_; }
  void advance() { ++step_; }
  /// Goes on behind so many steps that an earlier run has made.
  void resume_after(int steps_done) { step_ = steps_done; }

  /// The step being solved counts from 1; its time is the new one [ms].
  int step() const { return step_ + 1; }
  double time() const { return step() * step_size_; }
  double step_size() const { return step_size_; }
  /// Δt of the step before; zero in the first one [ms].
  double previous_step_size() const { return step_ == 0 ? 0.0 : step_size_; }
  int steps() const { return steps_; }

private:
  double step_size_;
  int steps_;
  int step_ = 0;
};

params::Table time_table();

}  // namespace tunica::stepping
