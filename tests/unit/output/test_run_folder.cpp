#include <Teuchos_UnitTestHarness.hpp>

#include "tunica/base/error.hpp"
#include "tunica/output/run_folder.hpp"
#include "unit/io/scratch.hpp"

namespace tunica::output::test {

TEUCHOS_UNIT_TEST(run_folder, creates_the_folder_with_its_parents) {
  const std::string path = scratch("folder") + "/of/a/run";
  const RunFolder folder(path, world());
  TEST_ASSERT(std::filesystem::is_directory(path));
  TEST_ASSERT(std::filesystem::is_empty(path));
  TEST_EQUALITY(folder.file("steps.csv"), path + "/steps.csv");
}

TEUCHOS_UNIT_TEST(run_folder, is_content_with_an_existing_folder) {
  const std::string path = scratch("twice");
  const RunFolder first(path, world());
  TEST_NOTHROW(RunFolder(path, world()));
}

TEUCHOS_UNIT_TEST(run_folder, unwritable_folder_is_an_error_on_all_ranks) {
  const std::string path = scratch("blocked");
  const RunFolder folder(path, world());
  if (world()->getRank() == 0) std::ofstream(folder.file("file")) << "in the way";
  TEST_THROW(RunFolder(folder.file("file"), world()), Error);
  TEST_THROW(RunFolder(folder.file("file/below"), world()), Error);
  TEST_THROW(RunFolder("/proc/tunica", world()), Error);
}

}  // namespace tunica::output::test
