#include "tunica/stepping/period.hpp"

#include <cmath>

#include "tunica/base/error.hpp"
#include "tunica/base/told_apart.hpp"

namespace tunica::stepping {

bool closes_period(double period, std::vector<double>& times) {
  constexpr double round_off = 1e-5;
  const double end = times.front() + period;
  if (std::abs(times.back() - end) > round_off * period) return false;
  times.back() = end;
  return true;
}

void check_span(double period, std::vector<double> times, const std::string& path) {
  const auto [span, most] = told_apart(times.back() - times.front(), period);
  closes_period(period, times);
  const std::size_t n = times.size();
  const double end = times.front() + period;
  TUNICA_CHECK(times.back() <= end && (n < 2 || times[n - 2] < end),
               path + ": the times span " + span + " ms, more than the period of " + most +
                   " ms. Omit the times beyond it, or correct the period.");
}

}  // namespace tunica::stepping
