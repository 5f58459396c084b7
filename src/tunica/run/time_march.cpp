#include "tunica/run/time_march.hpp"

#include <cmath>
#include <sstream>

#include "tunica/base/error.hpp"
#include "tunica/io/progress.hpp"
#include "tunica/output/traffic_report.hpp"

namespace tunica::run {

namespace {

Parts with_their_parts(const Parts& parts) {
  Parts all;
  for (const auto& [name, part] : parts) {
    all.emplace_back(name, part);
    for (const auto& [inner, its_part] : part->inner_parts())
      all.emplace_back(name + " " + inner, its_part);
  }
  return all;
}

}  // namespace

stepping::StepControl step_control(const setup::Case& the_case) {
  const stepping::StepControlOptions& steps = the_case.time->steps;
  const bool has_times = !the_case.time->is_steady_sought();
  return {steps, the_case.kinks,
          has_times ? the_case.output.times_of_fields(steps.end) : std::vector<double>()};
}

TimeMarch::TimeMarch(const setup::Case& the_case, const Parts& parts, RunOutput& output)
    : output_(&output), parts_(with_their_parts(parts)), control_(step_control(the_case)),
      made_(control_.clock()), tolerance_(the_case.time->tolerance) {}

Outcome TimeMarch::outcome() const {
  if (is_stopped_ || !control_.is_steady_sought() || control_.is_steady())
    return Outcome::success();
  std::ostringstream reason;
  reason << "the flow is not steady after " << made_.step() << " steps: the last one, of "
         << made_.step_size() << " ms, has changed it by " << eta_ << " times what is permitted";
  return Outcome::failure(reason.str());
}

void TimeMarch::judge(observe::Field& field) {
  if (!tolerance_) return;
  if (auto error = field.step_error(*tolerance_))
    errors_.emplace_back(field.name() + " steps", std::move(error));
}

Parts TimeMarch::parts() const {
  Parts all(parts_);
  for (const auto& [name, error] : errors_) all.emplace_back(name, error.get());
  return all;
}

TimeMarch::Numbers TimeMarch::save() const {
  Numbers numbers = control_.save();
  numbers["counts"] = {double(counts_.failed), double(counts_.inaccurate),
                       double(counts_.unconverged), double(counts_.over_tolerance)};
  return numbers;
}

void TimeMarch::restore(const Numbers& numbers) {
  control_.restore(numbers);
  made_ = control_.clock();
  const std::vector<double>& counts = numbers.at("counts");
  counts_ = {int(counts.at(0)), int(counts.at(1)), int(counts.at(2)), int(counts.at(3))};
}

std::vector<fields::State> TimeMarch::save_parts() const {
  std::vector<fields::State> states;
  const int every = output_->settings.checkpoint_every;
  const bool may_be_written = every > 0 && !made_.is_every(every);  // otherwise it is, or unwanted
  if (control_.may_repeat() || may_be_written)
    for (const auto& [name, part] : parts()) states.push_back(part->save());
  return states;
}

int TimeMarch::last_ended() const {
  return is_in_step_ ? static_cast<int>(numbers_before_.at("steps").at(0))
                     : control_.clock().step() - 1;
}

double TimeMarch::time_of_last() const {
  return (is_in_step_ ? numbers_before_ : save()).at("start").at(0);
}

TimeMarch::Place TimeMarch::undo() {
  if (is_in_step_) restore_parts();
  return {last_ended(), time_of_last(), is_in_step_ ? numbers_before_ : save()};
}

void TimeMarch::restore_parts() const {
  auto state = before_.begin();
  for (const auto& [name, part] : parts()) part->restore(*state++);
}

void TimeMarch::tell_repeat(const RunLog& log, const std::string& reason) const {
  std::ostringstream text;
  text << "step " << control_.clock().step() << " is repeated with " << control_.clock().step_size()
       << " ms: " << reason;
  log.note(text.str());
}

bool TimeMarch::is_too_inaccurate(StepSummary& step, const RunLog& log) {
  problems::StepError::Estimate worst;
  for (const auto& [name, error] : errors_) {
    const problems::StepError::Estimate one = error->estimate(control_.clock());
    if (!(one.eta <= worst.eta)) worst = one;
  }
  step.error = worst.ratio;
  eta_ = worst.eta;
  if (eta_ <= 1.0 || control_.is_steady_sought()) return false;
  std::ostringstream reason;
  reason << "time " << control_.clock().time() << " ms: the error estimate is " << worst.ratio
         << " times what is permitted";
  if (control_.shorten(eta_)) {
    tell_repeat(log, reason.str());
    return true;
  }
  log.warn(reason.str() + ", with the smallest step");
  ++counts_.over_tolerance;
  return false;
}

bool TimeMarch::is_to_repeat(StepSummary& step, const RunLog& log) {
  eta_ = tolerance_ ? 1.0 : 0.0;  // nobody knows: no longer steps
  if (tolerance_) step.error = std::nan("");
  if (step.is_converged) {
    const bool repeats = !errors_.empty() && is_too_inaccurate(step, log);
    counts_.inaccurate += repeats;
    return repeats;
  }
  if (!control_.cut()) return false;
  tell_repeat(log, step.reason);
  ++counts_.failed;
  return true;
}

void TimeMarch::accept(const StepSummary& step) {
  for (const auto& [name, error] : errors_) error->accept();
  if (!step.is_converged) ++counts_.unconverged;
  control_.advance(eta_);
}

StepSummary TimeMarch::make_step(const Solve& solve, RunLog& log) {
  const bool is_first = !has_made_step_;
  if (is_first) output_->record.note_memory("solvers");
  before_ = save_parts();
  numbers_before_ = save();
  is_in_step_ = true;
  StepSummary step;
  for (int attempt = 1;; ++attempt) {
    made_ = control_.clock();
    const io::ProgressScope scope("step " + std::to_string(made_.step()));
    step = solve(made_, attempt);
    step.rejected = attempt - 1;
    if (!is_to_repeat(step, log)) break;
    restore_parts();
  }
  if (step.is_accepted) accept(step);
  if (control_.is_done()) made_.end_here();  // as one may know only now
  const auto note = [&](const char* what, int count) { output_->record.set("steps", what, count); };
  note("accepted", control_.clock().step() - 1);
  note("accepted unconverged", counts_.unconverged);
  note("accepted over the error tolerance", counts_.over_tolerance);
  note("failed and repeated", counts_.failed);
  note("inaccurate and repeated", counts_.inaccurate);
  output_->unconverged_steps = counts_.unconverged;
  if (is_first) {
    output_->record.note_memory("first step");
    output::restart_traffic();
  } else {
    ++output_->steps_of_traffic;
  }
  has_made_step_ = true;
  return step;
}

}  // namespace tunica::run
