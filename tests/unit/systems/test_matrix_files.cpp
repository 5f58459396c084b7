#include <Teuchos_UnitTestHarness.hpp>
#include <cstdio>
#include <fstream>

#include "tunica/base/error.hpp"
#include "tunica/systems/matrix_files.hpp"

namespace {

using namespace tunica;

constexpr const char* file = "matrix_files.mtx";

/// What a reader says of a file with this text.
template <class Read>
std::string refusal(const std::string& text, const Read& read) {
  std::ofstream(file) << text;
  std::string reason;
  try {
    read(file);
  } catch (const Error& error) {
    reason = error.what();
  }
  std::remove(file);
  return reason;
}

std::string of_matrix(const std::string& text) { return refusal(text, systems::read_matrix); }
std::string of_column(const std::string& text) { return refusal(text, systems::read_column); }

systems::FileMatrix matrix(const std::string& text) {
  std::ofstream(file) << text;
  const systems::FileMatrix A = systems::read_matrix(file);
  std::remove(file);
  return A;
}

constexpr const char* general = "%%MatrixMarket matrix coordinate real general\n";
constexpr const char* array = "%%MatrixMarket matrix array real general\n";

TEUCHOS_UNIT_TEST(matrix_files, entries_come_in_any_order_with_comments_and_empty_lines) {
  const auto A = matrix(std::string(general) +
                        "% by hand\n\n2 3 4\n2 3 4.5\n1 1 1\n% more\n2 1 -3e2\n1 2 +2\n");
  TEST_EQUALITY(A.n_rows, 2);
  TEST_EQUALITY(A.n_columns, 3);
  TEST_COMPARE_ARRAYS(A.start, (std::vector<std::size_t>{0, 2, 4}));
  TEST_COMPARE_ARRAYS(A.columns, (std::vector<long long>{0, 1, 0, 2}));
  TEST_COMPARE_ARRAYS(A.values, (std::vector<double>{1, 2, -300, 4.5}));
}

TEUCHOS_UNIT_TEST(matrix_files, exponents_of_fortran_are_exponents) {
  const auto A = matrix(std::string(general) + "1 2 2\n1 1 1.0D+03\n1 2 -2.5d-1\n");
  TEST_COMPARE_ARRAYS(A.values, (std::vector<double>{1000.0, -0.25}));
}

TEUCHOS_UNIT_TEST(matrix_files, symmetric_files_hold_one_half_and_repeated_entries_add_up) {
  const auto A =
      matrix("%%MatrixMarket MATRIX Coordinate Real Symmetric\n2 2 3\n1 1 1\n2 1 5\n1 1 2\n");
  TEST_COMPARE_ARRAYS(A.columns, (std::vector<long long>{0, 1, 0}));
  TEST_COMPARE_ARRAYS(A.values, (std::vector<double>{3, 5, 5}));
}

TEUCHOS_UNIT_TEST(matrix_files, what_does_not_belong_there_is_told_with_line_and_column) {
  const auto says = [](const std::string& reason, const std::string& what) {
    return reason.find(what) != std::string::npos;
  };
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

TEUCHOS_UNIT_TEST(matrix_files, columns_have_a_number_in_each_line_and_no_more_of_them) {
  const std::string head = array;
  TEST_EQUALITY(of_column(head + "2 1\n1\n2.5D0\n"), "");
  TEST_ASSERT(of_column(head + "2 1\n1\n").find("expected 2 numbers") != std::string::npos);
  TEST_ASSERT(of_column(head + "2 1\n1\n2\n3\n").find("a line too many") != std::string::npos);
  TEST_ASSERT(of_column(head + "2 1\n1\n2 3\n").find(":4:3: \"3\" does") != std::string::npos);
  TEST_ASSERT(of_column(head + "2 1\n1\nx\n").find("found \"x\"") != std::string::npos);
  TEST_ASSERT(of_column(head + "1 2\n1\n2\n").find("2 columns, expected one") != std::string::npos);
}

}  // namespace
