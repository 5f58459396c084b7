#include <Teuchos_UnitTestHarness.hpp>

#include "tunica/base/error.hpp"

namespace {

using namespace tunica;

TEUCHOS_UNIT_TEST(error, check_throws_an_error_with_its_message) {
  try {
    TUNICA_CHECK(1 > 2, std::string("one is not ") + "greater");
    TEST_ASSERT(false);
  } catch (const Error& error) {
    TEST_EQUALITY(std::string(error.what()), "one is not greater");
  }
}

TEUCHOS_UNIT_TEST(error, check_builds_no_message_where_the_condition_holds) {
  int built = 0;
  const auto message = [&built] {
    ++built;
    return std::string("never");
  };
  TUNICA_CHECK(2 > 1, message());
  TEST_EQUALITY(built, 0);
}

TEUCHOS_UNIT_TEST(error, a_broken_promise_is_no_error_of_the_user) {
  TEST_THROW(detail::broken_promise("a > b", "a is small", "x.cpp", 7), std::logic_error);
  try {
    detail::broken_promise("a > b", "a is small", "x.cpp", 7);
  } catch (const std::logic_error& fault) {
    TEST_EQUALITY(std::string(fault.what()), "x.cpp:7: a > b: a is small");
  }
}

TEUCHOS_UNIT_TEST(error, asserts_speak_in_debug_builds_only) {
#ifdef NDEBUG
  TUNICA_ASSERT(false, "not evaluated");
#else
  TEST_THROW(TUNICA_ASSERT(false, "evaluated"), std::logic_error);
#endif
}

}  // namespace
