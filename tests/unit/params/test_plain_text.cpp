#include <Teuchos_UnitTestHarness.hpp>
#include <sstream>

#include "tunica/base/error.hpp"
#include "tunica/params/plain_text.hpp"

namespace {

using namespace tunica;
using namespace tunica::params;

/// What is said of a text.
template <class Use>
std::string complaint_of(const Use& use) {
  try {
    use();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEUCHOS_UNIT_TEST(plain_text, marks_and_ends_of_lines_are_those_of_any_system) {
  const std::string wanted = "0,20\n\n500,40\n";
  for (const char* text : {"0,20\n\n500,40\n", "0,20\r\n\r\n500,40\r\n", "0,20\r\r500,40\r"})
    for (const std::string mark : {"", "\xef\xbb\xbf"})
      TEST_EQUALITY(plain_text(mark + text, "flow.csv"), wanted);
  TEST_EQUALITY(plain_text("", "flow.csv"), "");
  TEST_EQUALITY(plain_text("\xef\xbb", "flow.csv"), "\xef\xbb");
}

TEUCHOS_UNIT_TEST(plain_text, wide_characters_are_refused_by_name) {
  for (const std::string& text : {std::string("\xff\xfe"
                                              "0\0",
                                              4),
                                  std::string("\xfe\xff\0"
                                              "0",
                                              4),
                                  std::string("0\0,\0", 4), std::string("\0\0\xfe\xff", 4)}) {
    const std::string said = complaint_of([&] { plain_text(text, "flow.csv"); });
    TEST_ASSERT(said.find("flow.csv: ") == 0 && said.find("expected UTF-8") != std::string::npos);
    std::istringstream in(text);
    const std::string said_at_once = complaint_of([&] { begin_text(in, "flow.csv"); });
    TEST_EQUALITY(said_at_once, said);
  }
}

TEUCHOS_UNIT_TEST(plain_text, large_texts_begin_behind_their_mark) {
  for (const std::string mark : {"", "\xef\xbb\xbf"}) {
    std::istringstream in(mark + "first\r\nsecond\n");
    begin_text(in, "A.mtx");
    std::string line;
    std::getline(in, line);
    TEST_EQUALITY(line, "first\r");
  }
  for (const char* text : {"", "alone", "alone\r", "\r\n"}) {
    std::istringstream in(text);
    const std::string said = complaint_of([&] { begin_text(in, "A.mtx"); });
    TEST_EQUALITY(said, "");
  }
  std::istringstream old("first\rsecond\r");
  const std::string said = complaint_of([&] { begin_text(old, "A.mtx"); });
  TEST_ASSERT(said.find("carriage return") != std::string::npos);
}

}  // namespace
