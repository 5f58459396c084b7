#pragma once
#include <string>
#include <vector>

namespace tunica::stepping {

/// Whether the last of the times lies a period behind the first one, but for the digits with which
/// both were written (a part of the period of 1e-5). Then it does so to the last digit.
bool closes_period(double period, std::vector<double>& times);

/// Throws Error that begins with the path where the times span more than that.
void check_span(double period, std::vector<double> times, const std::string& path);

}  // namespace tunica::stepping
