#include <Teuchos_UnitTestHarness.hpp>

#include "helpers.hpp"
#include "tunica/systems/matrix_files.hpp"

namespace {

using namespace tunica;
using namespace tunica::systems_tests;

constexpr const char* general = "%%MatrixMarket matrix coordinate real general\n";
constexpr const char* array = "%%MatrixMarket matrix array real general\n";

/// What a reader says of a file with this text.
std::string of_matrix(const std::string& text) {
  const File file(text);
  return refusal([&] { systems::read_matrix(file.path, world(), at_once); });
}
std::string of_column(const std::string& text) {
  const File file(text);
  return refusal([&] { systems::read_column(file.path, world(), at_once); });
}

/// The whole, on each rank.
systems::MatrixRows matrix(const std::string& text) {
  const File file(text);
  return systems::read_matrix(file.path, alone(), at_once);
}

/// Whether the ranks have their portions of a matrix.
bool is_portion(const systems::MatrixRows& mine, const systems::MatrixRows& whole) {
  const auto first = static_cast<std::size_t>(mine.first_row());
  bool is_same = mine.n_rows == whole.n_rows && mine.n_columns == whole.n_columns &&
                 mine.columns.size() == mine.start.back();
  for (std::size_t i = 0; i < mine.n_local_rows(); ++i) {
    const std::size_t length = mine.start[i + 1] - mine.start[i];
    is_same = is_same && length == whole.start[first + i + 1] - whole.start[first + i];
    for (std::size_t k = 0; is_same && k < length; ++k)
      is_same = mine.columns[mine.start[i] + k] == whole.columns[whole.start[first + i] + k] &&
                mine.values[mine.start[i] + k] == whole.values[whole.start[first + i] + k];
  }
  return is_same;
}

/// Reads a file on all ranks, a few lines at once.
bool is_read_in_pieces(const std::string& text) {
  const File file(text);
  const systems::MatrixRows whole = systems::read_matrix(file.path, alone());
  for (const std::size_t lines : {1, 3, 4, 1000})
    if (!is_portion(systems::read_matrix(file.path, world(), lines), whole)) return false;
  return true;
}

TEUCHOS_UNIT_TEST(matrix_files, entries_come_in_any_order_with_comments_and_empty_lines) {
  const auto A = matrix(std::string(general) +
                        "% by hand\n\n2 3 4\n2 3 4.5\n1 1 1\n% more\n2 1 -3e2\n1 2 +2\n");
  TEST_EQUALITY(A.n_rows, 2);
  TEST_EQUALITY(A.n_columns, 3);
  TEST_COMPARE_ARRAYS(A.start, (std::vector<std::size_t>{0, 2, 4}));
  TEST_COMPARE_ARRAYS(A.columns, (std::vector<long long>{0, 1, 0, 2}));
  TEST_COMPARE_ARRAYS(A.values, (std::vector<double>{1, 2, -300, 4.5}));
}

TEUCHOS_UNIT_TEST(matrix_files, a_byte_order_mark_is_passed_over) {
  const auto A = matrix("\xef\xbb\xbf" + std::string(general) + "1 1 1\r\n1 1 3\r\n");
  TEST_COMPARE_ARRAYS(A.values, (std::vector<double>{3}));
}

TEUCHOS_UNIT_TEST(matrix_files, exponents_of_fortran_are_exponents) {
  const auto A = matrix(std::string(general) + "1 2 2\n1 1 1.0D+03\n1 2 -2.5d-1\n");
  TEST_COMPARE_ARRAYS(A.values, (std::vector<double>{1000.0, -0.25}));
}

TEUCHOS_UNIT_TEST(matrix_files, symmetric_files_hold_one_half_and_repeated_entries_add_up) {
  const std::string text =
      "%%MatrixMarket MATRIX Coordinate Real Symmetric\n2 2 5\n1 1 1\n2 1 5\n1 1 2\n2 1 3\n1 1 4\n";
  const auto A = matrix(text);
  TEST_COMPARE_ARRAYS(A.columns, (std::vector<long long>{0, 1, 0}));
  TEST_COMPARE_ARRAYS(A.values, (std::vector<double>{7, 8, 8}));
  TEST_ASSERT(is_read_in_pieces(text));
}

TEUCHOS_UNIT_TEST(matrix_files, symmetric_files_with_both_triangles_are_refused) {
  const std::string head = "%%MatrixMarket matrix coordinate real symmetric\n";
  TEST_ASSERT(says(of_matrix(head + "2 2 3\n1 1 1\n2 1 5\n1 2 5\n"),
                   "the first line says \"symmetric\", but there are entries below the "
                   "diagonal (row 2, column 1) and above it (row 1, column 2)"));
  TEST_COMPARE_ARRAYS(matrix(head + "2 2 1\n1 2 5\n").values, (std::vector<double>{5, 5}));
}

TEUCHOS_UNIT_TEST(matrix_files, compressed_files_are_named_as_such) {
  TEST_ASSERT(says(of_matrix("\x1f\x8b\x08 and so on"), "is compressed. Unpack it first"));
}

TEUCHOS_UNIT_TEST(matrix_files, every_rank_has_its_rows_however_few_lines_are_read_at_once) {
  std::string text = std::string(general) + "7 5 22\n";
  for (int k = 0; k < 22; ++k)  // each place twice, the second time much later; none in row 4
    text += std::to_string(k % 3 + 1 + 4 * (k % 2)) + " " + std::to_string(k % 11 % 5 + 1) + " " +
            std::to_string(0.1 * k) + "\n";
  TEST_ASSERT(is_read_in_pieces(text));
  TEST_ASSERT(is_read_in_pieces(std::string(general) + "3 0 0\n"));
  TEST_ASSERT(is_read_in_pieces(std::string(general) + "1 9 2\n1 9 2\n1 1 3\n"));
}

TEUCHOS_UNIT_TEST(matrix_files, a_transpose_is_where_its_rows_are) {
  const std::string head = general;
  const std::string entries[] = {"2 5 1", "1 1 2", "3 2 3", "1 5 4"},
                    turned[] = {"5 2 1", "1 1 2", "2 3 3", "5 1 4"};
  std::string A = head + "3 5 4\n", AT = head + "5 3 4\n";
  for (int k = 0; k < 4; ++k) {
    A += entries[k] + "\n";
    AT += turned[k] + "\n";
  }
  const systems::MatrixRows whole = matrix(AT);
  const File file(A);
  TEST_ASSERT(is_portion(systems::transposed(systems::read_matrix(file.path, world())), whole));
}

TEUCHOS_UNIT_TEST(matrix_files, diagonals_are_added_where_they_lack) {
  const std::string head = general;
  const systems::MatrixRows whole =
      matrix(head + "4 4 7\n1 1 0\n1 2 1\n2 1 1\n2 2 0\n3 3 5\n4 3 1\n4 4 0\n");
  const File file(head + "4 4 4\n1 2 1\n2 1 1\n3 3 5\n4 3 1\n");
  TEST_ASSERT(is_portion(systems::with_diagonal(systems::read_matrix(file.path, world())), whole));
}

TEUCHOS_UNIT_TEST(matrix_files, rows_of_other_ranks_are_fetched_in_their_order) {
  const File file(std::string(general) + "5 5 5\n1 2 12\n2 1 21\n4 4 44\n4 1 41\n5 3 53\n");
  const auto A = systems::read_matrix(file.path, world());
  std::vector<double> values;
  for (const auto& entry : systems::fetch_rows(A, {0, 2, 3, 4})) values.push_back(entry.value);
  TEST_COMPARE_ARRAYS(values, (std::vector<double>{12, 41, 44, 53}));
}

TEUCHOS_UNIT_TEST(matrix_files, what_does_not_belong_there_is_told_with_line_and_column) {
  const std::string head = general;
  TEST_ASSERT(says(of_matrix(head + "2 2 2\n1 1 1\n"), ":4:1: the file ends, expected 2 entries"));
  TEST_ASSERT(says(of_matrix(head + "2 2 1\n1 1 1\n2 2 1\n"), ":4:1: a line too many"));
  TEST_ASSERT(says(of_matrix(head + "2 2 1\n1 1 1.0junk\n"),
                   ":3:5: expected the value, found \"1.0junk\""));
  TEST_ASSERT(says(of_matrix(head + "2 2 1\n1 1 1 7\n"), ":3:7: \"7\" does not belong here"));
  TEST_ASSERT(says(of_matrix(head + "2 2 1\n1 1\n"), "expected the value, found \"\""));
  TEST_ASSERT(says(of_matrix(head + "2 2 1\n1 3 1\n"), ":3:3: the column is 3, expected 1 to 2"));
  TEST_ASSERT(says(of_matrix(head + "2 2 1\n1 1 nan\n"), "is not finite"));
  TEST_ASSERT(says(of_matrix(head + "2 2\n"), ":2:4: expected a size"));
  TEST_ASSERT(says(of_matrix("1 1 1\n"), ":1:"));
  TEST_ASSERT(says(of_matrix("%%MatrixMarket matrix coordinate pattern general\n1 1 1\n1 1\n"),
                   "\"pattern\""));
  TEST_ASSERT(says(of_matrix(array), "the layout is \"array\""));
}

TEUCHOS_UNIT_TEST(matrix_files, what_is_wrong_in_a_later_piece_is_told_to_all_ranks) {
  const std::string good = std::string(general) + "9 9 5\n1 1 1\n2 2 1\n3 3 1\n4 4 1\n";
  TEST_ASSERT(says(of_matrix(good + "5 x 1\n"), ":7:3: expected the column, found \"x\""));
  TEST_ASSERT(says(of_matrix(good), ":7:1: the file ends, expected 5 entries"));
  TEST_ASSERT(says(of_matrix(good + "5 5 1\n6 6 1\n"), ":8:1: a line too many"));
  TEST_ASSERT(says(of_column(std::string(array) + "5 1\n1\n2\n3\n4\nx\n"), ":7:1: "));
}

TEUCHOS_UNIT_TEST(matrix_files, columns_have_a_number_in_each_line_and_no_more_of_them) {
  const std::string head = array;
  TEST_EQUALITY(of_column(head + "2 1\n1\n2.5D0\n"), "");
  TEST_ASSERT(says(of_column(head + "2 1\n1\n"), "expected 2 numbers"));
  TEST_ASSERT(says(of_column(head + "2 1\n1\n2\n3\n"), "a line too many"));
  TEST_ASSERT(says(of_column(head + "2 1\n1\n2 3\n"), ":4:3: \"3\" does"));
  TEST_ASSERT(says(of_column(head + "2 1\n1\nx\n"), "found \"x\""));
  TEST_ASSERT(says(of_column(head + "1 2\n1\n2\n"), "2 columns, expected one"));
}

TEUCHOS_UNIT_TEST(matrix_files, every_rank_has_its_portion_of_a_column) {
  const File file(std::string(array) + "7 1\n0\n1\n2\n3\n4\n5\n6\n");
  const systems::ColumnRows column = systems::read_column(file.path, world(), at_once);
  const Portion portion = portion_of(7, *world());
  TEST_EQUALITY(column.n_rows, 7);
  TEST_EQUALITY(column.values.size(), static_cast<std::size_t>(portion.count));
  for (std::size_t i = 0; i < column.values.size(); ++i)
    TEST_EQUALITY(column.values[i], static_cast<double>(portion.first + static_cast<long long>(i)));
}

}  // namespace
