#include <Teuchos_UnitTestHarness.hpp>

#include "tunica/base/agreement.hpp"
#include "tunica/base/error.hpp"
#include "tunica/base/session.hpp"

namespace {

using namespace tunica;

TEUCHOS_UNIT_TEST(agreement, silence_of_all_is_silence) {
  TEST_EQUALITY(agreed_message(*all_ranks(), ""), "");
}

TEUCHOS_UNIT_TEST(agreement, one_complaint_reaches_all_ranks) {
  const int last = all_ranks()->getSize() - 1;
  const std::string mine = all_ranks()->getRank() == last ? "the last rank complains" : "";
  TEST_EQUALITY(agreed_message(*all_ranks(), mine), "the last rank complains");
}

TEUCHOS_UNIT_TEST(agreement, the_lowest_rank_speaks_for_all) {
  TEST_EQUALITY(agreed_message(*all_ranks(), "rank " + std::to_string(all_ranks()->getRank())),
                "rank 0");
}

TEUCHOS_UNIT_TEST(agreement, on_root_throws_the_same_on_all_ranks) {
  std::string message;
  try {
    on_root(*all_ranks(), [] { throw Error("line 3 is wrong"); });
  } catch (const Error& error) {
    message = error.what();
  }
  TEST_EQUALITY(message, "line 3 is wrong");
}

TEUCHOS_UNIT_TEST(agreement, on_root_works_on_rank_0_only) {
  int worked = 0;
  on_root(*all_ranks(), [&worked] { ++worked; });
  TEST_EQUALITY(worked, all_ranks()->getRank() == 0 ? 1 : 0);
}

TEUCHOS_UNIT_TEST(agreement, on_all_throws_what_one_rank_complains_of) {
  const int last = all_ranks()->getSize() - 1;
  std::string message;
  int worked = 0;
  try {
    on_all(*all_ranks(), [&] {
      ++worked;
      if (all_ranks()->getRank() == last) throw Error("line 3 is wrong");
    });
  } catch (const Error& error) {
    message = error.what();
  }
  TEST_EQUALITY(message, "line 3 is wrong");
  TEST_EQUALITY(worked, 1);
}

TEUCHOS_UNIT_TEST(agreement, broadcast_replaces_longer_and_shorter_texts) {
  std::string text =
      all_ranks()->getRank() == 0 ? "seven" : std::string(all_ranks()->getRank() * 4, 'x');
  broadcast(*all_ranks(), text);
  TEST_EQUALITY(text, "seven");
  std::string empty = all_ranks()->getRank() == 0 ? "" : "something";
  broadcast(*all_ranks(), empty);
  TEST_EQUALITY(empty, "");
}

}  // namespace
