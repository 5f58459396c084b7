#include <unistd.h>

#include <Teuchos_UnitTestHarness.hpp>

#include "tunica/io/folder_lock.hpp"
#include "unit/io/scratch.hpp"

namespace tunica::io {

namespace {

/// A folder of the calling rank.
std::string folder(const std::string& name) {
  const std::string path =
      output::test::scratch(name) + "-" + std::to_string(output::test::world()->getRank());
  std::filesystem::remove_all(path);
  std::filesystem::create_directories(path);
  return path;
}

}  // namespace

TEUCHOS_UNIT_TEST(folder_lock, lets_one_in_and_names_it_to_the_other) {
  const std::string place = folder("locked");
  FolderLock one, other;
  TEST_ASSERT(one.take(place).is_success());
  TEST_ASSERT(one.take(place).is_success());
  const Outcome refused = other.take(place);
  TEST_ASSERT(refused.is_failure());
  TEST_ASSERT(refused.reason().find("process " + std::to_string(::getpid()) + " on host ") !=
              std::string::npos);
  one.give_back();
  TEST_ASSERT(std::filesystem::is_empty(place));
  TEST_ASSERT(other.take(place).is_success());
}

TEUCHOS_UNIT_TEST(folder_lock, is_not_held_by_what_a_killed_process_has_left) {
  const std::string place = folder("stale");
  std::ofstream(place + "/.tunica-lock") << "1 elsewhere\n";
  FolderLock lock;
  TEST_ASSERT(lock.take(place).is_success());
  const std::string words = output::test::content(place + "/.tunica-lock");
  TEST_EQUALITY(words.find(std::to_string(::getpid()) + " "), 0u);
}

TEUCHOS_UNIT_TEST(folder_lock, leaves_a_folder_alone_that_is_not_there) {
  FolderLock lock;
  TEST_ASSERT(lock.take("/nowhere/at all").is_success());
}

}  // namespace tunica::io
