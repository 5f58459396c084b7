#include <Teuchos_UnitTestHarness.hpp>

#include "tunica/base/error.hpp"
#include "tunica/stepping/step_control.hpp"

namespace {

using namespace tunica;
using stepping::Clock;

TEUCHOS_UNIT_TEST(clock, steps_count_from_one_and_carry_the_new_time) {
  Clock clock(0.125, 3);
  TEST_EQUALITY(clock.step(), 1);
  TEST_EQUALITY(clock.time(), 0.125);
  clock.advance();
  TEST_EQUALITY(clock.step(), 2);
  TEST_EQUALITY(clock.time(), 0.25);
}

TEUCHOS_UNIT_TEST(clock, a_loop_makes_as_many_steps_as_asked) {
  int made = 0;
  for (Clock clock(0.1, 7); !clock.is_done(); clock.advance()) ++made;
  TEST_EQUALITY(made, 7);
}

TEUCHOS_UNIT_TEST(clock, goes_on_behind_the_steps_of_an_earlier_run) {
  stepping::Clock clock(0.125, 7);
  clock.resume_after(5, 0.125, 0.125);
  TEST_EQUALITY(clock.step(), 6);
  TEST_EQUALITY(clock.time(), 0.75);
  clock.resume_after(7, 0.125, 0.125);
  TEST_ASSERT(clock.is_done());
}

TEUCHOS_UNIT_TEST(clock, ten_million_steps_collect_no_rounding) {
  Clock clock(0.1, 10000000);
  for (int n = 1; n < 10000000; ++n) clock.advance();
  TEST_FLOATING_EQUALITY(clock.time(), 1e6, 1e-15);
}

TEUCHOS_UNIT_TEST(clock, the_list_sets_step_size_and_steps) {
  Teuchos::ParameterList list;
  list.set("step size", 0.5);
  list.set("steps", 4);
  stepping::time_table().resolve(list, "Time", "");
  const Clock clock(list);
  TEST_EQUALITY(clock.step_size(), 0.5);
  TEST_EQUALITY(clock.steps(), 4);
  list.set("steps", 0);
  TEST_THROW(stepping::time_table().resolve(list, "Time", ""), Error);
}

}  // namespace
