#pragma once
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "tunica/base/reduce.hpp"

namespace tunica::judge {

/// The median of values that the ranks have: of n the one behind n/2 others. for_each hands every
/// value of the rank to what it is given, each time it is called; nothing is stored. Found in ever
/// smaller intervals, to 1e-9 of the values' range. 0 where there is none. Collective.
template <class ForEach>
double global_median(const Comm& comm, const ForEach& for_each) {
  constexpr int bins = 512, rounds = 4;
  constexpr double far = std::numeric_limits<double>::max();
  double low = far, high = -far, count = 0.0;
  for_each([&](double value) {
    low = std::min(low, value);
    high = std::max(high, value);
    ++count;
  });
  low = global_min(comm, low);
  high = global_max(comm, high);
  count = global_sum(comm, count);
  if (count == 0.0) return 0.0;
  double wanted = std::floor(0.5 * count);  // so many are before it
  for (int round = 0; round < rounds && high > low; ++round) {
    const double width = (high - low) / bins;
    std::vector<double> found(bins, 0.0);
    for_each([&](double value) {
      if (value >= low && value <= high)
        ++found[std::min(bins - 1, static_cast<int>((value - low) / width))];
    });
    found = global_sum(comm, found);
    int bin = 0;
    while (bin + 1 < bins && wanted >= found[bin]) wanted -= found[bin++];
    low += bin * width;
    high = low + width;
  }
  return 0.5 * (low + high);
}

}  // namespace tunica::judge
