#include <Teuchos_UnitTestHarness.hpp>

#include "tunica/run/run_log.hpp"

namespace {

using tunica::run::rough_duration;

TEUCHOS_UNIT_TEST(run_log, a_duration_is_told_in_the_unit_that_suits_it) {
  TEST_EQUALITY(rough_duration(0.2), "1 s");
  TEST_EQUALITY(rough_duration(89.0), "89 s");
  TEST_EQUALITY(rough_duration(12.3 * 60.0), "12 min");
  TEST_EQUALITY(rough_duration(2.6 * 3600.0), "3 h");
  TEST_EQUALITY(rough_duration(80.0 * 3600.0), "3 days");
}

}  // namespace
