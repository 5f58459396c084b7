#include "tunica/kernels/tet4.hpp"

#include <cmath>

namespace tunica::kernels {

double element_length(double volume) {
  constexpr double six_sqrt2 = 8.48528137423857;
  return std::cbrt(six_sqrt2 * volume);
}

}  // namespace tunica::kernels
