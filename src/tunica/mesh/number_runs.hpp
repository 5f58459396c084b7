#pragma once
#include <map>

namespace tunica::mesh {

/// Places of numbers that come one after the other, but for gaps and jumps, as those of nodes and
/// elements in files: takes room for each run of such numbers, not for each number.
class NumberRuns {
public:
  NumberRuns() = default;
  NumberRuns(const NumberRuns&) = delete;
  NumberRuns& operator=(const NumberRuns&) = delete;

  /// Gives the number the next place. False, and it has none, if it was there before.
  bool add(long long number);
  /// Place of a number; -1 where it was not added.
  long long find(long long number) const;

private:
  struct Run {
    long long place, count;
  };
  using Runs = std::map<long long, Run>;  // by the first number
  /// The run that has the number, or the end.
  Runs::const_iterator run_of(long long number) const;

  Runs runs_;
  Runs::iterator last_ = runs_.end();                  ///< the run that grows
  mutable Runs::const_iterator found_ = runs_.cend();  ///< most likely the next, too
  long long places_ = 0;
};

}  // namespace tunica::mesh
