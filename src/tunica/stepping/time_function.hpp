#pragma once
#include <utility>
#include <vector>

#include "tunica/params/table.hpp"
#include "tunica/stepping/spline.hpp"

namespace tunica::stepping {

/// A factor that depends on time: constant one, a Fourier series, or a table with linear or smooth
/// interpolation or with steps. Before the first and after the last time of a table its end values
/// hold, unless it has a period, with which it is repeated for all times. With steps a value holds
/// from its time (exclusive) to the next one (inclusive).
class TimeFunction {
public:
  TimeFunction() = default;
  /// From a resolved "Amplitude" list.
  explicit TimeFunction(const Teuchos::ParameterList& options);

  double operator()(double time) const;
  /// Where it jumps or its slope does, up to a time.
  std::vector<double> kinks(double end) const;
  /// Period of the repetition [ms]; 0: none.
  double period() const { return period_; }
  /// A period, or up to the last time of a table [ms]; 0 where it is constant.
  double span() const;
  /// The least and the largest value of a table; zeros where there is none.
  std::pair<double, double> table_range() const;

private:
  double in_table(double time) const;
  std::vector<double> kinks_of_table() const;

  enum class Kind { constant, linear, steps, spline, fourier };
  Kind kind_ = Kind::constant;
  double period_ = 0.0;
  /// Times of the table; for a periodic table they span the period, with the first value repeated
  /// at the end.
  std::vector<double> times_;
  std::vector<double> values_;
  Spline spline_;
  double mean_ = 0.0;
  std::vector<double> cosines_, sines_;
};

params::Table time_function_table();

/// How long a table with a period has no values before it is repeated, where this is more than
/// twice the longest time between two of them and its ends differ, so that what lies between is
/// made up; otherwise 0 [ms].
double gap_in_period(const Teuchos::ParameterList& amplitude);

/// The times up to end at which an amplitude of the list, or below it, is not smooth [ms].
std::vector<double> kinks(const Teuchos::ParameterList& list, double end);

/// Replaces the files of all amplitudes in the list and below it by their samples, so that one
/// rank alone reads them and the list stands alone.
void inline_files(Teuchos::ParameterList& list);

}  // namespace tunica::stepping
