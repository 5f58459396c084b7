#include <Teuchos_DefaultComm.hpp>
#include <Teuchos_UnitTestHarness.hpp>
#include <functional>
#include <new>
#include <stdexcept>
#include <string>

#include "tunica/base/attempt.hpp"
#include "tunica/base/failed_ranks.hpp"
#include "tunica/base/fault_point.hpp"

using namespace tunica;

namespace {

CommPtr world() { return Teuchos::DefaultComm<int>::getComm(); }
std::string number() { return std::to_string(world()->getRank()); }

/// Whether the work is done behind this failure, which goes on.
bool does_work_behind(const std::function<void()>& failure, int stage = 7) {
  side_channel(*world());
  world()->barrier();  // between exchanges, of which a program has one
  bool is_done = false;
  try {
    failure();
  } catch (...) {
    do_if_all_fail_alike(*world(), stage, [&] {
      world()->barrier();
      fault_point("behind the failure");
      is_done = true;
      throw std::runtime_error("another, which nobody hears of");
    });
  }
  return is_done;
}

TEUCHOS_UNIT_TEST(failed_ranks, do_what_is_collective_where_all_fail_alike) {
  fault_point("the failure");
  TEST_ASSERT(does_work_behind([] { throw std::runtime_error("a singular matrix"); }));
  TEST_ASSERT(does_work_behind([] { throw "words alone"; }));
  TEST_EQUALITY(std::string(last_fault_point()), "the failure");
}

TEUCHOS_UNIT_TEST(failed_ranks, do_nothing_where_exceptions_or_places_differ) {
  const bool is_alone = world()->getSize() == 1;
  TEST_EQUALITY(does_work_behind([] { throw std::runtime_error("rank " + number()); }), is_alone);
  TEST_EQUALITY(does_work_behind([] { throw std::bad_alloc(); }, world()->getRank()), is_alone);
  fault_point(world()->getRank() == 0 ? "here" : "there");
  TEST_EQUALITY(does_work_behind([] { throw std::bad_alloc(); }), is_alone);
}

}  // namespace
