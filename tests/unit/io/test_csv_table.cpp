#include <Teuchos_UnitTestHarness.hpp>
#include <cstdlib>
#include <limits>

#include "tunica/io/csv_table.hpp"
#include "tunica/output/run_folder.hpp"
#include "unit/io/scratch.hpp"

namespace tunica::output::test {

using namespace io;

namespace {

/// A folder in which every rank may write files of its own name.
std::string own_file(const std::string& name) {
  const RunFolder folder(scratch("csv"), world());
  return folder.file(name + std::to_string(world()->getRank()));
}

}  // namespace

TEUCHOS_UNIT_TEST(csv_table, numbers_come_back_bit_by_bit) {
  const std::string path = own_file("numbers");
  const std::vector<double> numbers{
      0.1, 1.0 / 3.0, -2.5e-300, 1e22, 5e-324, 0.0, std::numeric_limits<double>::max()};
  CsvTable table(path, {"value"}, true);
  for (const double number : numbers) table.row({number});

  std::istringstream lines(content(path));
  std::string line;
  std::getline(lines, line);
  TEST_EQUALITY(line, "value");
  for (const double number : numbers) {
    std::getline(lines, line);
    TEST_EQUALITY(std::strtod(line.c_str(), nullptr), number);
    TEST_COMPARE(line.size(), <=, 24u);
  }
}

TEUCHOS_UNIT_TEST(csv_table, is_on_the_disk_after_each_row) {
  const std::string path = own_file("rows");
  CsvTable table(path, {"step", "time", "field"}, true);
  TEST_EQUALITY(content(path), "step,time,field\n");
  table.row({1, 0.5, "fluid"});
  TEST_EQUALITY(content(path), "step,time,field\n1,0.5,fluid\n");
  table.row({true, 1e-9, "a \"b\", c"});
  TEST_EQUALITY(content(path), "step,time,field\n1,0.5,fluid\n1,1e-09,\"a \"\"b\"\", c\"\n");
}

TEUCHOS_UNIT_TEST(csv_table, replaces_the_file_of_an_earlier_run) {
  const std::string path = own_file("earlier");
  CsvTable(path, {"a"}, true).row({1});
  CsvTable(path, {"a"}, true).row({2});
  TEST_EQUALITY(content(path), "a\n2\n");
}

/// Where a table goes that cannot be continued.
std::string aside(const std::string& path, const std::string& number = "") {
  const std::filesystem::path file(path);
  return (file.parent_path() / file.stem()).string() + ".old" + number + file.extension().string();
}

TEUCHOS_UNIT_TEST(csv_table, keeps_whole_rows_up_to_a_step) {
  const std::string path = own_file("kept");
  std::ofstream(path) << "step,a\n1,10\n1,11\n2,20\n3,30\n2";
  CsvTable(path, {"step", "a"}, true, 2).row({3, 31});
  TEST_EQUALITY(content(path), "step,a\n1,10\n1,11\n2,20\n3,31\n");
  TEST_ASSERT(!std::filesystem::exists(aside(path)));
}

TEUCHOS_UNIT_TEST(csv_table, sets_aside_a_table_with_other_columns) {
  const std::string path = own_file("columns");
  std::ofstream(path) << "step,a\n1,10\n";
  CsvTable(path, {"step", "b"}, true, 1).row({2, 20});
  TEST_EQUALITY(content(path), "step,b\n2,20\n");
  TEST_EQUALITY(content(aside(path)), "step,a\n1,10\n");
  CsvTable(path, {"step", "c"}, true, 2).row({3, 30});
  TEST_EQUALITY(content(aside(path)), "step,a\n1,10\n");
  TEST_EQUALITY(content(aside(path, "-2")), "step,b\n2,20\n");
}

TEUCHOS_UNIT_TEST(csv_table, begins_where_there_is_nothing_to_keep) {
  const std::string path = own_file("nothing");
  CsvTable(path, {"step"}, true, 7).row({8});
  TEST_EQUALITY(content(path), "step\n8\n");
}

TEUCHOS_UNIT_TEST(csv_table, does_nothing_when_inactive) {
  const std::string path = own_file("inactive");
  CsvTable(path, {"a"}, false).row({1});
  TEST_ASSERT(!std::filesystem::exists(path));
}

TEUCHOS_UNIT_TEST(csv_table, row_of_wrong_length_is_refused) {
  CsvTable table("unused", {"a", "b"}, false);
  TEST_THROW(table.row({1}), std::logic_error);
}

TEUCHOS_UNIT_TEST(csv_table, full_disk_is_an_error_that_names_the_file) {
  std::string message;
  try {
    CsvTable("/dev/full", {"a"}, true).row({1});
  } catch (const std::runtime_error& error) {
    message = error.what();
  }
  TEST_EQUALITY(message, "cannot write /dev/full: No space left on device");
}

}  // namespace tunica::output::test
