#include "tunica/stepping/pseudo_time.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tunica::stepping {

namespace {

/// Infinite steps within which the change has to be halved; if not, finite ones are taken.
constexpr int halving_steps = 10;

double largest_of(const Teuchos::ParameterList& time) {
  const double largest = time.get<double>("largest step");
  return largest > 0.0 ? largest : std::numeric_limits<double>::infinity();
}

}  // namespace

PseudoTime::PseudoTime(const Teuchos::ParameterList& time)
    : largest_(largest_of(time)), size_(std::min(time.get<double>("step size"), largest_)),
      last_grown_(size_), smallest_growth_(time.get<double>("smallest growth")),
      largest_growth_(time.get<double>("largest growth")),
      infinite_below_(time.get<double>("infinite below") / time.get<double>("tolerance")),
      most_cuts_(time.get<int>("cuts")) {}

bool PseudoTime::cut() {
  if (cuts_ >= most_cuts_) return false;
  ++cuts_;
  if (size_ > last_grown_) {
    size_ = last_grown_;
    infinite_below_ *= 0.1;  // it was too early
  } else {
    size_ *= 0.25;
  }
  return true;
}

void PseudoTime::advance(double change) {
  is_steady_ = size_ >= largest_ && change <= 1.0;
  if (size_ >= largest_) return watch_infinite_steps(change);
  const double rate = change / size_;
  double growth = last_rate_ > 0.0 ? last_rate_ / rate : smallest_growth_;
  growth = cuts_ > 0 ? 1.0 : std::clamp(growth, smallest_growth_, largest_growth_);
  last_rate_ = rate;
  last_grown_ = std::min(growth * size_, largest_);
  size_ = change <= infinite_below_ ? largest_ : last_grown_;
  cuts_ = 0;
}

// Infinite steps are Newton's method but for the recovered residual, which lags by one step. Where
// that keeps them from settling, steps as long as the last finite one do.
void PseudoTime::watch_infinite_steps(double change) {
  if (!std::isinf(size_)) return;
  ++since_halved_;
  if (change <= 0.5 * halved_change_) {
    halved_change_ = change;
    since_halved_ = 0;
  }
  if (since_halved_ >= halving_steps) largest_ = size_ = last_grown_;
}

std::vector<double> PseudoTime::save() const {
  return {size_,    last_grown_,    infinite_below_,    last_rate_, is_steady_ ? 1.0 : 0.0,
          largest_, halved_change_, since_halved_ * 1.0};
}

void PseudoTime::restore(const std::vector<double>& numbers) {
  size_ = numbers.at(0);
  last_grown_ = numbers.at(1);
  infinite_below_ = numbers.at(2);
  last_rate_ = numbers.at(3);
  is_steady_ = numbers.at(4) != 0.0;
  if (numbers.size() == 5) return;  // of an earlier version
  largest_ = numbers.at(5);
  halved_change_ = numbers.at(6);
  since_halved_ = static_cast<int>(numbers.at(7));
}

params::Table steady_table() {
  const params::Range below_one{0.0, 1.0, true, true};
  params::Table table("steps in pseudo-time to a steady flow");
  table.integer("steps", 200, params::between(1, 1e9), "maximum number of steps")
      .number("tolerance", 1e-8, below_one, "1",
              "the flow is steady if a step without time derivative, or one of the largest size, "
              "changes the velocity by at most this part of it (root mean square), and the "
              "displacement of a wall")
      .number("velocity scale", 1e-3, params::positive(), "mm/ms",
              "smaller velocities are judged as if they were of this size")
      .number("load time", 0.0, params::between(0.0, 1e12), "ms",
              "time at which loads are taken; pseudo-time does not change them")
      .number("smallest growth", 1.5, params::Range{1.0, 100.0, true, false}, "1",
              "a step is at least so many times as long as the one before, unless that was cut")
      .number("largest growth", 10.0, params::Range{1.0, 1e6, true, false}, "1",
              "and at most so many times; in between it grows as the rate of change falls")
      .number("infinite below", 0.05, below_one, "1",
              "once a step changes the velocity by less than this part, the next has no time "
              "derivative, or is the largest")
      .number(
          "largest step", 0.0, params::non_negative(), "ms",
          "upper bound, which fluid and wall together need; 0: none. It should be long compared "
          "with the time in which they settle")
      .number("newton increment", 0.01, below_one, "1",
              "relative increment at which Newton's method of a step stops, instead of that of the "
              "fluid or of the coupling: the next step continues")
      .integer("cuts", 20, params::between(0, 50),
               "how often in a row a step that fails is cut to a quarter and repeated");
  return table;
}

}  // namespace tunica::stepping
