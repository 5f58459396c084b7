#include <Teuchos_UnitTestHarness.hpp>
#include <algorithm>
#include <cmath>

#include "tunica/base/pack.hpp"

namespace {

using namespace tunica;

TEUCHOS_UNIT_TEST(pack, has_the_cube_roots_of_the_library) {
  double worst = 0.0;
  for (int exponent = -300; exponent <= 300; ++exponent)
    for (double digits = 1.0; digits < 10.0; digits += 0.37) {
      const double cube = digits * std::pow(10.0, exponent);
      Pack four = cube;
      for (int lane = 1; lane < Pack::size; ++lane) four.set(lane, (1.0 + lane) * cube);
      const Pack root = cbrt(four);
      for (int lane = 0; lane < Pack::size; ++lane)
        worst = std::max(worst, std::abs(root[lane] / std::cbrt(four[lane]) - 1.0));
    }
  TEST_COMPARE(worst, <, 1e-15);
  TEST_EQUALITY(cbrt(Pack(1.0))[0], 1.0);  // of no deformation
  TEST_ASSERT(std::isnan(cbrt(Pack(std::nan("")))[3]));
}

}  // namespace
