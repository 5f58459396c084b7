#include <Teuchos_DefaultComm.hpp>
#include <Teuchos_UnitTestHarness.hpp>
#include <new>
#include <stdexcept>

#include "tunica/base/attempt.hpp"
#include "tunica/base/error.hpp"

using namespace tunica;

namespace {

CommPtr world() { return Teuchos::DefaultComm<int>::getComm(); }
bool is_last() { return world()->getRank() == world()->getSize() - 1; }
std::string last_rank() { return std::to_string(world()->getSize() - 1); }

TEUCHOS_UNIT_TEST(attempt, success_is_that_of_all) {
  int done = 0;
  TEST_ASSERT(attempt(*world(), "counting", [&] { ++done; }).is_success());
  TEST_EQUALITY(done, 1);
}

TEUCHOS_UNIT_TEST(attempt, failure_of_one_rank_is_the_failure_of_all) {
  const Outcome outcome = attempt(*world(), "counting", [] {
    if (is_last()) throw std::runtime_error("a zero pivot on rank " + last_rank());
  });
  TEST_ASSERT(outcome.is_failure());
  TEST_EQUALITY(outcome.reason(), "a zero pivot on rank " + last_rank());
}

TEUCHOS_UNIT_TEST(attempt, lowest_of_the_failed_ranks_is_heard) {
  const Outcome outcome = attempt(
      *world(), "counting", [] { throw Error("rank " + std::to_string(world()->getRank())); });
  TEST_EQUALITY(outcome.reason(), "rank 0");
}

std::string fault_of(const std::function<void()>& work) {
  try {
    return attempt(*world(), "setting up", work).reason();
  } catch (const MachineFault& fault) {
    return std::string("fault: ") + fault.what();
  }
}

TEUCHOS_UNIT_TEST(attempt, exhausted_memory_is_a_fault_on_all_ranks_and_no_verdict) {
  const auto work = [] {
    if (is_last()) throw std::bad_alloc();
    throw std::runtime_error("another, which counts for less");
  };
  const std::string told = fault_of(work);
  TEST_EQUALITY(told.find("fault: out of memory on rank " + last_rank()), 0u);
  TEST_ASSERT(told.find("while setting up") != std::string::npos);
}

TEUCHOS_UNIT_TEST(all_meet, holds_where_all_come) { TEST_ASSERT(all_meet(*world())); }

TEUCHOS_UNIT_TEST(side_channel, is_made_once) {
  TEST_ASSERT(side_channel(*world()) == side_channel(*world()));
}

}  // namespace
