#include <Teuchos_UnitTestHarness.hpp>
#include <Tpetra_Core.hpp>

#include "tunica/base/agreement.hpp"
#include "tunica/base/error.hpp"

namespace {

using namespace tunica;

CommPtr world() { return Tpetra::getDefaultComm(); }

TEUCHOS_UNIT_TEST(agreement, silence_of_all_is_silence) {
  TEST_EQUALITY(agreed_message(*world(), ""), "");
}

TEUCHOS_UNIT_TEST(agreement, one_complaint_reaches_all_ranks) {
  const int last = world()->getSize() - 1;
  const std::string mine = world()->getRank() == last ? "the last rank complains" : "";
  TEST_EQUALITY(agreed_message(*world(), mine), "the last rank complains");
}

TEUCHOS_UNIT_TEST(agreement, the_lowest_rank_speaks_for_all) {
  TEST_EQUALITY(agreed_message(*world(), "rank " + std::to_string(world()->getRank())), "rank 0");
}

TEUCHOS_UNIT_TEST(agreement, on_root_throws_the_same_on_all_ranks) {
  std::string message;
  try {
    on_root(*world(), [] { throw Error("line 3 is wrong"); });
  } catch (const Error& error) {
    message = error.what();
  }
  TEST_EQUALITY(message, "line 3 is wrong");
}

TEUCHOS_UNIT_TEST(agreement, on_root_works_on_rank_0_only) {
  int worked = 0;
  on_root(*world(), [&worked] { ++worked; });
  TEST_EQUALITY(worked, world()->getRank() == 0 ? 1 : 0);
}

TEUCHOS_UNIT_TEST(agreement, on_all_throws_what_one_rank_complains_of) {
  const int last = world()->getSize() - 1;
  std::string message;
  int worked = 0;
  try {
    on_all(*world(), [&] {
      ++worked;
      if (world()->getRank() == last) throw Error("line 3 is wrong");
    });
  } catch (const Error& error) {
    message = error.what();
  }
  TEST_EQUALITY(message, "line 3 is wrong");
  TEST_EQUALITY(worked, 1);
}

TEUCHOS_UNIT_TEST(agreement, broadcast_replaces_longer_and_shorter_texts) {
  std::string text = world()->getRank() == 0 ? "seven" : std::string(world()->getRank() * 4, 'x');
  broadcast(*world(), text);
  TEST_EQUALITY(text, "seven");
  std::string empty = world()->getRank() == 0 ? "" : "something";
  broadcast(*world(), empty);
  TEST_EQUALITY(empty, "");
}

}  // namespace
