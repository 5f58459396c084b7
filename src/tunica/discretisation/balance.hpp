#pragma once
#include <vector>

namespace tunica::discretisation {

/// Elements are counted by J = det F in so many bins: fine ones where J is about 1, where an
/// element keeps its volume, as the logarithm of |J − 1| goes beyond 1e-6.
constexpr int volume_ratio_bins = 900;
int bin_of_volume_ratio(double J);

/// The J that a part of the counted elements lies below, linear within its bin: |J − 1| is known to
/// four per cent. Not a number where there are none.
double quantile_of_volume_ratio(const std::vector<double>& counts, double part);

}  // namespace tunica::discretisation
