#include "tunica/stepping/step_control.hpp"

#include <algorithm>
#include <cmath>

#include "tunica/params/check_order.hpp"
#include "tunica/stepping/wall_limit.hpp"

namespace tunica::stepping {

StepControl::StepControl(const StepControlOptions& options, std::vector<double> kinks,
                         std::vector<double> asked_for)
    : options_(options), kinks_(options.is_adaptive ? std::move(kinks) : std::vector<double>()),
      asked_for_(std::move(asked_for)), clock_(options.first_step, options.most_steps, options.end),
      wanted_(options.first_step), pseudo_time_(options.pseudo_time) {
  std::sort(kinks_.begin(), kinks_.end());
  std::sort(asked_for_.begin(), asked_for_.end());
  plan();
}

// Times nearer than this are one.
double StepControl::slack() const { return 1e-9 * options_.first_step + 1e-14 * options_.end; }

bool StepControl::is_at(const std::vector<double>& times, double time) const {
  const auto next = std::lower_bound(times.begin(), times.end(), time - slack());
  return next != times.end() && *next <= time + slack();
}

bool StepControl::is_done() const {
  if (is_steady_sought()) return is_steady() || clock_.step() > options_.most_steps;
  return start_ >= options_.end - slack() ||
         (options_.is_adaptive && options_.most_steps > 0 && clock_.step() > options_.most_steps);
}

double StepControl::next_target() const {
  double target = options_.end;
  if (!options_.is_adaptive) target = (whole_steps_ + 1) * options_.first_step;
  for (const auto* times : {&kinks_, &asked_for_}) {
    const auto next = std::upper_bound(times->begin(), times->end(), start_ + slack());
    if (next != times->end()) target = std::min(target, *next);
  }
  return target;
}

void StepControl::plan() {
  if (is_steady_sought()) {
    const int step = clock_.step();
    clock_.set_step(
        {options_.end, pseudo_time_->size(), step, step == options_.most_steps, false, true});
    return;
  }
  const double whole = (whole_steps_ + 1) * options_.first_step;
  double target = next_target();
  if (!options_.is_adaptive && target > whole - slack()) target = whole;
  const double way = target - start_;
  const bool hits = way <= wanted_ * (1.0 + 1e-9);
  const double size = way < 2.0 * wanted_ ? 0.5 * way : wanted_;
  Clock::Plan next{start_ + size, size, 0, false, false, begins_anew_};
  if (hits) {
    const bool is_whole =
        !options_.is_adaptive && target == whole && start_ == whole_steps_ * options_.first_step;
    next.time = target;
    next.step_size = is_whole ? options_.first_step : way;
    next.is_asked_for = is_at(asked_for_, target);
    next.is_last = target >= options_.end - slack();
    if (!options_.is_adaptive && target == whole) next.count = whole_steps_ + 1;
  }
  if (options_.is_adaptive) {
    next.count = clock_.step();
    next.is_last = next.is_last || clock_.step() == options_.most_steps;
  }
  clock_.set_step(next);
}

void StepControl::repeat_with(double size) {
  wanted_ = size;
  is_repeated_ = true;
  plan();
}

bool StepControl::cut() {
  if (is_steady_sought()) {
    const bool is_cut = pseudo_time_->cut();
    plan();
    return is_cut;
  }
  const double size = options_.cut * clock_.step_size();
  if (cuts_ >= options_.cuts || size < options_.smallest) return false;
  ++cuts_;
  repeat_with(size);
  return true;
}

bool StepControl::shorten(double eta) {
  const double size = clock_.step_size();
  if (size <= options_.smallest) return false;
  // At a jump the error falls slower than its order promises: two attempts tell how it does.
  double power = 1.0;
  if (rejected_.size > 0.0) power = std::log(rejected_.eta / eta) / std::log(rejected_.size / size);
  rejected_ = {size, eta};
  power = power > 0.0 ? std::clamp(power, 0.2, 1.0) : 1.0;
  const double factor = std::isfinite(eta) ? options_.safety * std::pow(eta, -1.0 / power) : 0.0;
  repeat_with(std::max(options_.smallest, size * std::clamp(factor, options_.largest_cut, 0.9)));
  return true;
}

void StepControl::choose_next_size(double eta) {
  const double size = clock_.step_size();
  if (options_.is_adaptive) {
    double factor = options_.largest_growth;
    if (eta > 0.0 && last_eta_ > 0.0 && !is_repeated_)
      factor = options_.safety *
               std::pow(eta, -options_.integral_gain - options_.proportional_gain) *
               std::pow(last_eta_, options_.proportional_gain);
    else if (eta > 0.0)
      factor = options_.safety / eta;
    factor = std::clamp(factor, options_.largest_cut, is_repeated_ ? 1.0 : options_.largest_growth);
    // A step that was shortened to hit a time tells nothing against the size that was wanted.
    const double most = options_.largest_growth * size;
    wanted_ = factor < 1.0 ? factor * size : std::max(factor * size, std::min(wanted_, most));
    wanted_ = std::clamp(wanted_, options_.smallest, options_.largest);
  } else {
    wanted_ = std::min(options_.first_step, wanted_ / options_.cut);
  }
}

void StepControl::advance(double eta) {
  if (is_steady_sought())
    pseudo_time_->advance(eta);
  else
    choose_next_size(eta);
  last_eta_ = eta;
  if (clock_.count() > 0) whole_steps_ = clock_.count();
  start_ = clock_.time();
  begins_anew_ = is_at(kinks_, start_);
  if (begins_anew_) last_eta_ = 0.0;
  cuts_ = 0;
  is_repeated_ = false;
  rejected_ = {};
  clock_.advance();
  plan();
}

std::map<std::string, std::vector<double>> StepControl::save() const {
  const StepSizes& sizes = clock_.step_sizes();
  return {{"pseudo-time", is_steady_sought() ? pseudo_time_->save() : std::vector<double>{}},
          {"start", {start_}},
          {"steps", {static_cast<double>(clock_.step() - 1), static_cast<double>(whole_steps_)}},
          {"sizes", {wanted_, sizes.last, sizes.before}},
          {"last eta", {last_eta_}}};
}

void StepControl::restore(const std::map<std::string, std::vector<double>>& state) {
  if (is_steady_sought()) pseudo_time_->restore(state.at("pseudo-time"));
  start_ = state.at("start").at(0);
  whole_steps_ = static_cast<int>(state.at("steps").at(1));
  wanted_ = state.at("sizes").at(0);
  last_eta_ = state.at("last eta").at(0);
  clock_.resume_after(static_cast<int>(state.at("steps").at(0)), state.at("sizes").at(1),
                      state.at("sizes").at(2));
  begins_anew_ = is_at(kinks_, start_);
  plan();
}

StepControlOptions step_control_options(const Teuchos::ParameterList& time) {
  constexpr double any = std::numeric_limits<double>::infinity();
  StepControlOptions options{};
  options.is_adaptive = time.get<std::string>("step control") == "adaptive";
  options.first_step = time.get<double>("step size");
  options.cuts = time.get<int>("cuts");
  options.cut = 0.5;
  options.largest = any;
  const int steps = time.get<int>("steps");
  options.most_steps = steps;
  if (time.get<std::string>("step control") == "steady") {
    options.end = time.get<double>("load time");
    options.pseudo_time.emplace(time);
    return options;
  }
  if (!options.is_adaptive) {
    options.end = steps * options.first_step;
    return options;
  }
  options.end = time.get<double>("end time");
  options.smallest = time.get<double>("smallest step");
  if (const double largest = time.get<double>("largest step"); largest > 0.0)
    options.largest = largest;
  options.largest_cut = time.get<double>("largest cut");
  options.largest_growth = time.get<double>("largest growth");
  options.safety = time.get<double>("safety");
  options.integral_gain = time.get<double>("integral gain");
  options.proportional_gain = time.get<double>("proportional gain");
  return options;
}

namespace {

// What becomes of the error of a step, and of the one before, in the size of the next.
void add_controller(params::Table& table) {
  table
      .number("safety", 0.9, params::Range{0.0, 1.0, true, false}, "1",
              "part of the predicted step that is taken")
      .number("integral gain", 0.6, params::Range{0.0, 1.0, true, false}, "1",
              "weight of the last error in the choice of the next step")
      .number("proportional gain", 0.2, params::between(0.0, 1.0), "1",
              "weight of the change of the error");
}

params::Table adaptive_table() {
  const params::Range below_one{0.0, 1.0, true, true};
  params::Table table("steps as long as the error estimate permits");
  table
      .number("end time", std::nullopt, params::Range{0.0, 1e12, true, false}, "ms",
              "end of the run")
      .integer("steps", 0, params::non_negative(),
               "end after so many steps, if not before; 0: no limit")
      .number("tolerance", 0.01, below_one, "1",
              "error that may add up while the solution changes by its own size, relative to the "
              "largest displacement and velocity so far")
      .number("displacement scale", 0.01, params::positive(), "mm",
              "smaller displacements (root mean square over the wall) are judged as if they were "
              "of this size")
      .number("velocity scale", 0.1, params::positive(), "mm/ms",
              "smaller velocities of fluid and wall are judged as if they were of this size")
      .number("smallest step", 1e-6, params::positive(), "ms",
              "a step of this size is accepted with a warning, whatever its error; only a step "
              "that hits a time is shorter")
      .number("largest step", 0.0, params::non_negative(), "ms", "upper bound; 0: none")
      .number("largest growth", 2.0, params::Range{1.0, 2.4, true, false}, "1",
              "a step is at most so many times as long as the one before; BDF2 bears 1 + sqrt(2)")
      .number("largest cut", 0.1, below_one, "1",
              "and at least this multiple, also if it is repeated");
  add_controller(table);
  table
      .flag("hit kinks", true,
            "steps end where the amplitude of a load has a kink or a jump, and the time scheme "
            "begins anew there; without it the error estimate must find them")
      .integer("cuts", 10, params::between(0, 30),
               "how often in a row a step that fails is halved and repeated");
  table.check([](const Teuchos::ParameterList& list, const std::string& path) {
    params::check_order(list, path, "smallest step", "step size");
    if (list.get<double>("largest step") > 0.0)
      params::check_order(list, path, "step size", "largest step");
  });
  return table;
}

}  // namespace

params::Table time_table() {
  params::Table fixed("equidistant steps");
  fixed.integer("steps", std::nullopt, params::between(1, 1e9), "number of time steps")
      .integer("cuts", 0, params::between(0, 20),
               "how often in a row a step that fails is halved and repeated; the steps then return "
               "to their size; 0: the run ends");
  params::Table table("Time steps.");
  table
      .number("step size", std::nullopt, params::between(1e-12, 1e9), "ms",
              "time step; of adaptive or pseudo-time steps the first one")
      .variant("step control", "fixed",
               {{"fixed", fixed}, {"adaptive", adaptive_table()}, {"steady", steady_table()}},
               "choice of the step size; steady: a fluid, also with a wall, in pseudo-time");
  add_wall_limit(table);
  return table;
}

}  // namespace tunica::stepping
