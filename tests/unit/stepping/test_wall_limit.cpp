#include <Teuchos_UnitTestHarness.hpp>
#include <cmath>

#include "tunica/base/error.hpp"
#include "tunica/stepping/wall_limit.hpp"

namespace {

using tunica::stepping::seconds_of;

TEUCHOS_UNIT_TEST(wall_limit, is_in_seconds_or_as_batch_systems_write_it) {
  TEST_EQUALITY(seconds_of("90"), 90.0);
  TEST_EQUALITY(seconds_of("0.5"), 0.5);
  TEST_EQUALITY(seconds_of("1:30"), 90.0);
  TEST_EQUALITY(seconds_of("23:59:00"), 86340.0);
  TEST_EQUALITY(seconds_of("100:00:01.5"), 360001.5);
  TEST_ASSERT(std::isinf(seconds_of("")));
}

TEUCHOS_UNIT_TEST(wall_limit, is_nothing_else) {
  for (const char* text : {"0", "-1", "1h", "1:2:3:4", "1:60:00", "1:00:60", ":30", "1e3", " 1"})
    TEST_THROW(seconds_of(text), tunica::Error);
}

}  // namespace
