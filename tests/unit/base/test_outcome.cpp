#include <Teuchos_UnitTestHarness.hpp>
#include <vector>

#include "tunica/base/outcome.hpp"

using tunica::Outcome;
using tunica::Result;

namespace {

TEUCHOS_UNIT_TEST(outcome, success_has_no_reason) {
  const Outcome outcome = Outcome::success();
  TEST_ASSERT(outcome.is_success() && !outcome.is_failure());
  TEST_EQUALITY(outcome.reason(), "");
}

TEUCHOS_UNIT_TEST(outcome, failure_keeps_its_reason) {
  const Outcome outcome = Outcome::failure("element 7 is inverted");
  TEST_ASSERT(outcome.is_failure() && !outcome.is_success());
  TEST_EQUALITY(outcome.reason(), "element 7 is inverted");
}

TEUCHOS_UNIT_TEST(outcome, failure_without_words_is_a_failure) {
  TEST_ASSERT(Outcome::failure("").is_failure());
}

TEUCHOS_UNIT_TEST(outcome, place_stands_before_the_reason_of_failures_only) {
  TEST_EQUALITY(Outcome::failure("it grew").at("the wall").reason(), "the wall: it grew");
  TEST_ASSERT(Outcome::success().at("the wall").is_success());
}

TEUCHOS_UNIT_TEST(result, success_holds_the_value) {
  const Result<std::vector<int>> result = std::vector<int>{1, 2};
  TEST_ASSERT(result.is_success() && result.outcome().is_success());
  TEST_EQUALITY(result.value().size(), 2u);
}

TEUCHOS_UNIT_TEST(result, failure_has_a_reason_and_no_value) {
  const auto result = Result<int>::failure("singular");
  TEST_ASSERT(result.is_failure());
  TEST_EQUALITY(result.reason(), "singular");
  TEST_EQUALITY(result.outcome().at("here").reason(), "here: singular");
  TEST_THROW(result.value(), std::bad_optional_access);
}

TEUCHOS_UNIT_TEST(result, value_can_be_moved_out) {
  Result<std::vector<int>> result = std::vector<int>(3, 5);
  const std::vector<int> taken = std::move(result).value();
  TEST_EQUALITY(taken.size(), 3u);
}

}  // namespace
