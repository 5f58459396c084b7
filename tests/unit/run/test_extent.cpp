#include <Teuchos_UnitTestHarness.hpp>

#include "tunica/run/extent.hpp"

namespace {

using namespace tunica;

TEUCHOS_UNIT_TEST(Extent, text_has_three_digits_of_the_longest) {
  TEST_EQUALITY(run::extent_text({3.0, 3.0, 15.0}), "3.0 x 3.0 x 15.0 mm");
  TEST_EQUALITY(run::extent_text({0.003, 0.003, 0.015}), "0.0030 x 0.0030 x 0.0150 mm");
  TEST_EQUALITY(run::extent_text({2860.0, 2860.0, 18000.0}), "2860 x 2860 x 18000 mm");
  TEST_EQUALITY(run::extent_text({0.0, 0.0, 0.0}), "0 x 0 x 0 mm");
}

TEUCHOS_UNIT_TEST(Extent, other_units_than_mm_are_doubted) {
  TEST_EQUALITY(run::doubt_of_unit({3.0, 3.0, 0.5}), "");
  TEST_EQUALITY(run::doubt_of_unit({0.1, 0.1, 5000.0}), "");
  const std::string metres = run::doubt_of_unit({0.003, 0.003, 0.015});
  TEST_INEQUALITY(metres.find("0.0150 mm: is it in m? See \"Mesh / scale\"."), std::string::npos);
  const std::string micrometres = run::doubt_of_unit({3000.0, 3000.0, 15000.0});
  TEST_INEQUALITY(micrometres.find("15000 mm: is it in µm?"), std::string::npos);
}

}  // namespace
