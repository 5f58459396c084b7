#include <Teuchos_UnitTestHarness.hpp>

#include "tunica/base/error.hpp"
#include "tunica/io/atomic_file.hpp"
#include "tunica/output/run_folder.hpp"
#include "unit/io/full_disk.hpp"
#include "unit/io/scratch.hpp"

namespace tunica::output::test {

using namespace io;

namespace {

/// A file with the text "old" in a folder of its own. Only rank 0 goes on with it.
std::string old_file(const std::string& name) {
  const std::string path = RunFolder(scratch("atomic"), world()).file(name);
  if (world()->getRank() == 0) std::ofstream(path) << "old";
  return path;
}

bool is_alone(const std::string& path) {
  return !std::filesystem::exists(std::filesystem::symlink_status(AtomicFile::draft_of(path)));
}

std::string complaint(const std::string& path) {
  try {
    write_file(path, "text");
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEUCHOS_UNIT_TEST(atomic_file, the_old_one_stays_until_commit) {
  const std::string path = old_file("a.txt");
  if (world()->getRank() != 0) return;
  AtomicFile file(path);
  file.add("ne");
  file.add("w");
  TEST_ASSERT(file.close().is_success());
  TEST_EQUALITY(content(path), "old");
  TEST_EQUALITY(content(AtomicFile::draft_of(path)), "new");
  TEST_ASSERT(file.commit_to_disk().is_success());
  TEST_EQUALITY(content(path), "new");
  TEST_ASSERT(is_alone(path));
}

TEUCHOS_UNIT_TEST(atomic_file, without_commit_nothing_happens) {
  const std::string path = old_file("b.txt");
  if (world()->getRank() != 0) return;
  AtomicFile(path).add("new");
  TEST_EQUALITY(content(path), "old");
  TEST_ASSERT(is_alone(path));
}

TEUCHOS_UNIT_TEST(atomic_file, a_full_disk_leaves_the_old_one_and_is_told) {
  const std::string path = old_file("c.txt"), much(100000, 'x');
  if (world()->getRank() != 0) return;
  std::string problem;
  {
    const FullDisk full;
    problem = replace_file(path, much).reason();
  }
  TEST_EQUALITY(problem, "cannot write " + path + ".tmp: File too large");
  TEST_EQUALITY(content(path), "old");
  TEST_ASSERT(is_alone(path));
}

TEUCHOS_UNIT_TEST(atomic_file, what_cannot_get_its_name_is_removed) {
  const std::string folder = RunFolder(scratch("atomic/folder"), world()).path();
  if (world()->getRank() != 0) return;
  TEST_EQUALITY(replace_file(folder, "text").reason(),
                "cannot rename " + folder + ".tmp to " + folder + ": Is a directory");
  TEST_ASSERT(is_alone(folder));
}

TEUCHOS_UNIT_TEST(write_file, tells_the_user_what_is_wrong_with_the_name) {
  const std::string folder = RunFolder(scratch("atomic/named"), world()).path();
  if (world()->getRank() != 0) return;
  TEST_EQUALITY(complaint(""), "the name of the output file is empty");
  TEST_EQUALITY(complaint(folder), folder + ": is a directory, expected a file");
  TEST_EQUALITY(complaint("/nowhere/a.h5"),
                "/nowhere/a.h5: the folder does not exist. Create it first.");
  TEST_EQUALITY(complaint(folder + "/a.h5"), "");
  TEST_EQUALITY(content(folder + "/a.h5"), "text");
}

}  // namespace tunica::output::test
