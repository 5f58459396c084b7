#include <Teuchos_UnitTestHarness.hpp>
#include <Tpetra_CrsMatrix.hpp>

#include "tunica/base/trilinos.hpp"
#include "tunica/io/matrix_market.hpp"
#include "tunica/output/run_folder.hpp"
#include "unit/io/scratch.hpp"

namespace tunica::output::test {

using namespace io;

namespace {

std::string file(const std::string& name) {
  return RunFolder(scratch("market"), world()).file(name);
}

/// Every rank reads the file only once it is complete and before another test replaces it.
std::string common_content(const std::string& path) {
  world()->barrier();
  const std::string text = content(path);
  world()->barrier();
  return text;
}

/// Two rows on each rank, row i with i/3 in column i and a zero in column 0.
CrsMatrix arrow() {
  const auto map = Teuchos::rcp(new Map(2 * world()->getSize(), 0, world()));
  CrsMatrix A(map, 2);
  for (const GlobalOrdinal row : global_numbers(*map)) {
    A.insertGlobalValues(row, Teuchos::tuple(row), Teuchos::tuple(row / 3.0));
    if (row > 0) A.insertGlobalValues(row, Teuchos::tuple<GlobalOrdinal>(0), Teuchos::tuple(0.0));
  }
  A.fillComplete();
  return A;
}

}  // namespace

TEUCHOS_UNIT_TEST(matrix_market, a_matrix_keeps_every_entry_and_every_digit) {
  const std::string path = file("A.mtx");
  write_matrix_market(path, arrow(), -2.0, "an arrow");
  std::istringstream text(common_content(path));
  std::string line;
  std::getline(text, line);
  TEST_EQUALITY(line, "%%MatrixMarket matrix coordinate real general");
  std::getline(text, line);
  TEST_EQUALITY(line, "% an arrow");
  const int n = 2 * world()->getSize();
  int rows = 0, columns = 0, entries = 0, found = 0, last_row = 0;
  text >> rows >> columns >> entries;
  TEST_ASSERT(rows == n && columns == n && entries == 2 * n - 1);
  int row = 0, column = 0;
  for (std::string number; text >> row >> column >> number; ++found) {
    TEST_EQUALITY(std::stod(number), row == column ? -2.0 * ((row - 1) / 3.0) : 0.0);
    TEST_ASSERT(column == row || column == 1);
    TEST_COMPARE(row, >=, last_row);
    last_row = row;
  }
  TEST_EQUALITY(found, entries);
}

TEUCHOS_UNIT_TEST(matrix_market, parts_stand_below_each_other_column_by_column) {
  const std::string path = file("x.mtx");
  const auto map = Teuchos::rcp(new Map(world()->getSize(), 0, world()));
  MultiVector first(map, 2), second(map, 2);
  first.getVectorNonConst(0)->putScalar(0.1);
  first.getVectorNonConst(1)->putScalar(-1e-300);
  second.getVectorNonConst(0)->putScalar(2.0);
  second.getVectorNonConst(1)->putScalar(1.0 / 3.0);
  write_matrix_market(path, {&first, &second}, "");
  const int ranks = world()->getSize();
  std::string expected = "%%MatrixMarket matrix array real general\n";
  expected += std::to_string(2 * ranks) + " 2\n";
  for (const char* number : {"0.1\n", "2\n", "-1e-300\n", "0.3333333333333333\n"})
    for (int i = 0; i < ranks; ++i) expected += number;
  TEST_EQUALITY(common_content(path), expected);
}

TEUCHOS_UNIT_TEST(matrix_market, a_folder_that_is_not_there_is_told_on_all_ranks) {
  TEST_THROW(write_matrix_market("nowhere/A.mtx", arrow(), 1.0, ""), std::runtime_error);
}

}  // namespace tunica::output::test
