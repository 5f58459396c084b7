#pragma once
#include <vector>

namespace tunica::stepping {

/// The cubic spline through (t_i, y_i), by its slopes m_i there:
///
///   h_i m_{i−1} + 2 (h_{i−1} + h_i) m_i + h_{i−1} m_{i+1} = 3 (h_i s_{i−1} + h_{i−1} s_i)
///
///   h_i  t_{i+1} − t_i     s_i  (y_{i+1} − y_i)/h_i
///
/// It has continuous second derivatives. Either its slopes at both ends are zero, so that it goes
/// on as a constant, or it is periodic, where the last value is the first one again.
class Spline {
public:
  Spline() = default;
  /// times increase; at least two of them, three where it is periodic.
  Spline(std::vector<double> times, std::vector<double> values, bool is_periodic);

  /// t: between the first and the last time.
  double operator()(double t) const;

private:
  std::vector<double> times_, values_, slopes_;
};

}  // namespace tunica::stepping
