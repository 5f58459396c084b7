#pragma once
#include <vector>

#include "tunica/params/table.hpp"

namespace tunica::stepping {

/// A factor that depends on time: constant one, or a table with linear interpolation or with
/// steps. Before the first and after the last time of a table its end values hold. With steps
/// a value holds from its time (exclusive) to the next one (inclusive).
class TimeFunction {
public:
  TimeFunction() = default;
  /// From a resolved "Amplitude" list.
  explicit TimeFunction(const Teuchos::ParameterList& options);

  double operator()(double time) const;
  /// Where it jumps or its slope does.
  std::vector<double> kinks() const;

private:
  std::vector<double> times_;
  std::vector<double> values_;
  bool has_steps_ = false;
};

params::Table time_function_table();

/// The times at which an amplitude of the list, or below it, is not smooth [ms].
std::vector<double> kinks(const Teuchos::ParameterList& list);

/// Replaces the files of all amplitudes in the list and below it by their samples, so that one
/// rank alone reads them and the list stands alone.
void inline_files(Teuchos::ParameterList& list);

}  // namespace tunica::stepping
