#include <Teuchos_UnitTestHarness.hpp>
#include <iostream>
#include <sstream>

#include "tunica/io/messages.hpp"

namespace {

using namespace tunica;

/// std::cout writes to a text while it lives.
class Captured {
public:
  Captured() : before_(std::cout.rdbuf(text_.rdbuf())) {}
  ~Captured() { std::cout.rdbuf(before_); }
  Captured(const Captured&) = delete;
  Captured& operator=(const Captured&) = delete;
  std::string text() const { return text_.str(); }

private:
  std::ostringstream text_;
  std::streambuf* before_;
};

TEUCHOS_UNIT_TEST(silent_output, swallows_what_others_print_and_nothing_after) {
  const Captured output;
  {
    const io::SilentOutput silent;
    std::cout << "a table that nobody wants\n";
  }
  io::print_line("a message");
  TEST_EQUALITY(output.text(), "a message\n");
  TEST_EQUALITY(io::lost_output(), "");
}

TEUCHOS_UNIT_TEST(silent_output, does_not_hide_that_output_was_lost_before) {
  const Captured output;
  std::cout.setstate(std::ios_base::badbit);
  { const io::SilentOutput silent; }
  TEST_INEQUALITY(io::lost_output(), "");
  std::cout.clear();
}

}  // namespace
