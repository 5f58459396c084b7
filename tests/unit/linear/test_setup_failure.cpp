#include <Teuchos_DefaultComm.hpp>
#include <Teuchos_UnitTestHarness.hpp>
#include <new>
#include <set>

#include "tunica/base/error.hpp"
#include "tunica/linear/preconditioner_registry.hpp"
#include "tunica/linear/setup_failure.hpp"

using namespace tunica;
using linear::SetupFailure;

namespace {

CommPtr world() { return Teuchos::DefaultComm<int>::getComm(); }
bool is_last() { return world()->getRank() == world()->getSize() - 1; }

TEUCHOS_UNIT_TEST(set_up, failure_of_one_rank_is_thrown_by_all) {
  std::string message;
  try {
    linear::set_up(*world(), "the factors", [] {
      if (is_last()) throw std::runtime_error("a pivot is zero");
    });
  } catch (const SetupFailure& failure) {
    message = failure.what();
  }
  TEST_EQUALITY(message, "the factors cannot be set up: a pivot is zero");
}

TEUCHOS_UNIT_TEST(set_up, lack_of_memory_on_one_rank_is_a_fault_of_the_machine_on_all) {
  const auto work = [] {
    if (is_last()) throw std::bad_alloc();
  };
  TEST_THROW(linear::set_up(*world(), "the factors", work), MachineFault);
}

TEUCHOS_UNIT_TEST(preconditioners, have_names_of_their_own) {
  std::set<std::string> names;
  for (const linear::PreconditionerEntry& entry : linear::preconditioners())
    names.insert(entry.name);
  TEST_EQUALITY(names.size(), linear::preconditioners().size());
}

}  // namespace
