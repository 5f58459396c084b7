#include <sys/wait.h>
#include <unistd.h>

#include <Teuchos_UnitTestHarness.hpp>

#include "tunica/io/fatal_signals.hpp"

namespace tunica::io {

TEUCHOS_UNIT_TEST(deadline, ends_a_process_that_waits_longer) {
  const pid_t child = ::fork();
  if (child == 0) {
    const Deadline deadline(1, "waited, as it should");
    for (;;) ::pause();
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  TEST_ASSERT(WIFEXITED(status));
  TEST_INEQUALITY(WEXITSTATUS(status), 0);
}

TEUCHOS_UNIT_TEST(deadline, goes_on_after_one_within_it) {
  {
    const Deadline outer(500, "outer");
    { const Deadline inner(1000, "inner"); }
    const unsigned left = ::alarm(500);
    TEST_ASSERT(left > 0 && left <= 500);
  }
  TEST_EQUALITY(::alarm(0), 0u);
}

}  // namespace tunica::io
