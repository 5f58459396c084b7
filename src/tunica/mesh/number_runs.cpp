#include "tunica/mesh/number_runs.hpp"

#include <algorithm>
#include <iterator>
#include <limits>

namespace tunica::mesh {
namespace {

/// How far a number is behind the first of a run, which is not greater.
long long behind_first(long long number, long long first) {
  const auto distance =
      static_cast<unsigned long long>(number) - static_cast<unsigned long long>(first);
  return static_cast<long long>(
      std::min(distance, std::numeric_limits<unsigned long long>::max() / 2));
}

}  // namespace

NumberRuns::Runs::const_iterator NumberRuns::run_of(long long number) const {
  const auto has = [&](Runs::const_iterator run) {
    return number >= run->first && behind_first(number, run->first) < run->second.count;
  };
  if (found_ != runs_.end() && has(found_)) return found_;
  const auto behind = runs_.upper_bound(number);
  if (behind == runs_.begin() || !has(std::prev(behind))) return runs_.end();
  return found_ = std::prev(behind);
}

bool NumberRuns::add(long long number) {
  if (run_of(number) != runs_.end()) {
    ++places_;
    return false;
  }
  if (last_ != runs_.end() && number > last_->first &&
      behind_first(number, last_->first) == last_->second.count &&
      last_->second.place + last_->second.count == places_)
    ++last_->second.count;
  else
    last_ = runs_.emplace(number, Run{places_, 1}).first;
  ++places_;
  return true;
}

long long NumberRuns::find(long long number) const {
  const auto run = run_of(number);
  return run == runs_.end() ? -1 : run->second.place + (number - run->first);
}

}  // namespace tunica::mesh
