#include <Teuchos_UnitTestHarness.hpp>
#include <cmath>
#include <map>
#include <sstream>

#include "helpers.hpp"
#include "tunica/base/trilinos.hpp"
#include "tunica/systems/read_system.hpp"

namespace {

using namespace tunica;
using namespace tunica::systems_tests;

using Entries = std::map<std::pair<int, int>, double>;

std::string matrix_text(const Entries& entries, int n) {
  std::ostringstream text;
  text.precision(17);
  text << "%%MatrixMarket matrix coordinate real general\n"
       << n << ' ' << n << ' ' << entries.size() << '\n';
  for (const auto& [place, value] : entries)
    text << place.first + 1 << ' ' << place.second + 1 << ' ' << value << '\n';
  return text.str();
}
std::string column_text(const std::vector<double>& b) {
  std::ostringstream text;
  text.precision(17);
  text << "%%MatrixMarket matrix array real general\n" << b.size() << " 1\n";
  for (const double value : b) text << value << '\n';
  return text.str();
}

/// K = tridiag(-1, 2, -1) on a chain of n nodes.
Entries chain(int n) {
  Entries K;
  for (int i = 0; i < n; ++i) {
    K[{i, i}] = 2.0;
    if (i > 0) K[{i, i - 1}] = K[{i - 1, i}] = -1.0;
  }
  return K;
}
std::vector<double> product(const Entries& K, const std::vector<double>& x) {
  std::vector<double> b(x.size(), 0.0);
  for (const auto& [place, value] : K) b[place.first] += value * x[place.second];
  return b;
}

Teuchos::ParameterList options_for(const File& K, const File& b) {
  Teuchos::ParameterList options;
  options.set("K", K.path).set("rhs", b.path);
  systems::system_table().resolve(options, "System", "");
  return options;
}

/// Solves the prepared system of one matrix by dense elimination on rank 0, with what the options
/// say, and goes back to the order of the files.
struct Solved {
  explicit Solved(const Teuchos::ParameterList& options)
      : system(systems::read_system(options, alone())), x(solve()) {}

  std::vector<double> solve() const {
    const int fields = system.K.n_blocks();
    const auto n = static_cast<int>(system.K.n_unknowns());
    std::vector<std::vector<double>> M(n, std::vector<double>(n + 1, 0.0));
    std::vector<int> first(fields, 0);
    if (fields > 1) first[1] = static_cast<int>(system.b[0].getLocalLength());
    for (int i = 0; i < fields; ++i) {
      for (int j = 0; j < fields; ++j) {
        const CrsMatrix& A = *system.K(i, j);
        const auto local = A.getLocalMatrixHost();
        for (int row = 0; row < local.numRows(); ++row)
          for (int k = 0; k < local.rowConst(row).length; ++k)
            M[first[i] + row]
             [first[j] + A.getDomainMap()->getLocalElement(A.getColMap()->getGlobalElement(
                             local.rowConst(row).colidx(k)))] = local.rowConst(row).value(k);
      }
      const auto b = system.b[i].getLocalViewHost(read_only);
      for (std::size_t row = 0; row < b.extent(0); ++row) M[first[i] + row][n] = b(row, 0);
    }
    for (int p = 0; p < n; ++p) {
      int best = p;
      for (int row = p; row < n; ++row)
        if (std::abs(M[row][p]) > std::abs(M[best][p])) best = row;
      std::swap(M[p], M[best]);
      for (int row = 0; row < n; ++row)
        if (row != p && M[row][p] != 0.0) {
          const double factor = M[row][p] / M[p][p];
          for (int c = p; c <= n; ++c) M[row][c] -= factor * M[p][c];
        }
    }
    algebra::BlockVector y = system.K.zero();
    for (int i = 0; i < fields; ++i) {
      const auto values = y[i].getLocalViewHost(overwrite_all);
      for (std::size_t row = 0; row < values.extent(0); ++row)
        values(row, 0) = M[first[i] + row][n] / M[first[i] + row][first[i] + row];
    }
    const Vector all = in_file_order(system, in_units_of_files(system, y));
    const auto view = all.getLocalViewHost(read_only);
    return {view.data(), view.data() + view.extent(0)};
  }

  systems::System system;
  std::vector<double> x;
};

double largest_entry(const CrsMatrix& A) {
  const auto values = A.getLocalMatrixHost().values;
  double largest = 0.0;
  for (std::size_t k = 0; k < values.extent(0); ++k)
    largest = std::max(largest, std::abs(values(k)));
  return largest;
}
double largest_difference(const std::vector<double>& x, const std::vector<double>& y) {
  double largest = 0.0;
  for (std::size_t k = 0; k < x.size(); ++k) largest = std::max(largest, std::abs(x[k] - y[k]));
  return largest;
}
bool has_note(const systems::System& system, const std::string& words) {
  for (const std::string& note : system.notes)
    if (says(note, words)) return true;
  return false;
}

const std::vector<double> solution{1.0, -2.0, 3.0, -4.0, 5.0, -6.0};
constexpr int n = 6;

TEUCHOS_UNIT_TEST(preparation, sums_that_are_rounding_are_no_couplings) {
  Entries K = chain(n);
  K[{0, 4}] = K[{4, 0}] = 3e-17;
  const File matrix(matrix_text(K, n)), b(column_text(product(K, solution)));
  Teuchos::ParameterList options = options_for(matrix, b);
  const Solved solved(options);
  TEST_EQUALITY(static_cast<int>(solved.system.K(0, 0)->getGlobalNumEntries()), 3 * n - 2);
  TEST_EQUALITY(static_cast<int>((*solved.system.K.space())[0].nodes.graph->getGlobalNumEntries()),
                3 * n - 2);
  TEST_ASSERT(has_note(solved.system, "2 of 18 entries"));
  TEST_COMPARE(largest_difference(solved.x, solution), <, 1e-12);
  options.set("negligible", 0.0);
  TEST_EQUALITY(static_cast<int>(Solved(options).system.K(0, 0)->getGlobalNumEntries()), 3 * n);
}

TEUCHOS_UNIT_TEST(preparation, rows_with_a_diagonal_alone_give_known_values) {
  Entries K = chain(n);
  for (const int row : {0, n - 1})
    for (const int column : {row - 1, row + 1}) K.erase({row, column});
  K[{0, 0}] = 1.0;
  K[{n - 1, n - 1}] = 1e5;
  const File matrix(matrix_text(K, n)), b(column_text(product(K, solution)));
  Teuchos::ParameterList options = options_for(matrix, b);
  const Solved solved(options);
  TEST_ASSERT(has_note(solved.system, "rows 1 and 6 of K give the values"));
  // Their columns are empty, and their diagonals like the others.
  TEST_EQUALITY(static_cast<int>(solved.system.K(0, 0)->getGlobalNumEntries()), 3 * (n - 2));
  TEST_COMPARE(largest_entry(*solved.system.K(0, 0)), <=, 4.0);
  TEST_COMPARE(largest_difference(solved.x, solution), <, 1e-12);
  // What a method leaves there is no part of the solution.
  algebra::BlockVector left = solved.system.K.zero();
  left[0].putScalar(1e-9);
  const Vector x = in_file_order(solved.system, in_units_of_files(solved.system, left));
  const auto found = x.getLocalViewHost(read_only);
  TEST_EQUALITY(found(0, 0), solution.front());
  TEST_EQUALITY(found(n - 1, 0), solution.back());
  TEST_INEQUALITY(found(1, 0), 0.0);
  options.set("known values", false);
  TEST_EQUALITY(static_cast<int>(Solved(options).system.K(0, 0)->getGlobalNumEntries()), 3 * n - 4);
}

TEUCHOS_UNIT_TEST(preparation, penalties_give_known_values) {
  Entries K = chain(n);
  std::vector<double> b = product(K, solution);
  K[{0, 0}] = 1e20;
  b[0] = 1e20 * solution[0];
  const File matrix(matrix_text(K, n)), right(column_text(b));
  const Solved solved(options_for(matrix, right));
  TEST_ASSERT(has_note(solved.system, "row 1 of K give"));
  TEST_COMPARE(largest_entry(*solved.system.K(0, 0)), <=, 4.0);
  TEST_COMPARE(largest_difference(solved.x, solution), <, 1e-12);
}

TEUCHOS_UNIT_TEST(preparation, a_weak_penalty_is_scaled) {
  Entries K = chain(n);
  std::vector<double> b = product(K, solution);
  K[{0, 0}] = 1e8;
  b[0] = 1e8 * solution[0];
  const File matrix(matrix_text(K, n)), right(column_text(b));
  const Solved solved(options_for(matrix, right));
  TEST_ASSERT(has_note(solved.system, "row 1 of K are much larger"));
  TEST_COMPARE(largest_entry(*solved.system.K(0, 0)), <=, 4.0);
  TEST_COMPARE(largest_difference(solved.x, solution), <, 1e-6);
}

TEUCHOS_UNIT_TEST(preparation, units_of_rows_and_columns_do_not_count) {
  // Two fields: rows and columns of scalars in other units
  const auto system = [&](double of_vectors, double of_scalars) {
    Entries K = chain(8);
    for (int k = 0; k < 4; ++k) K[{8 + k, 2 * k}] = K[{2 * k, 8 + k}] = 1.0 + 0.1 * k;
    for (int k = 0; k < 4; ++k) K[{8 + k, 8 + k}] = -0.5;
    std::vector<double> x;
    for (auto& [place, value] : K)
      for (const int k : {place.first, place.second}) value *= k < 8 ? of_vectors : of_scalars;
    for (int k = 0; k < 12; ++k) x.push_back((k - 3.0) / (k < 8 ? of_vectors : of_scalars));
    const File matrix(matrix_text(K, 12)), b(column_text(product(K, x)));
    return Solved(options_for(matrix, b));
  };
  const Solved plain = system(1.0, 1.0), other = system(std::ldexp(1.0, 20), std::ldexp(1.0, -16));
  for (const int i : {0, 1})
    for (const int j : {0, 1})
      TEST_EQUALITY(largest_entry(*plain.system.K(i, j)), largest_entry(*other.system.K(i, j)));
  TEST_FLOATING_EQUALITY(plain.x[10], other.x[10] * std::ldexp(1.0, -16), 1e-12);
  TEST_FLOATING_EQUALITY(plain.x[10], 7.0, 1e-12);
}

TEUCHOS_UNIT_TEST(preparation, constants_in_the_null_space_are_found_and_held) {
  Entries K = chain(n);
  K[{0, 0}] = K[{n - 1, n - 1}] = 1.0;
  std::vector<double> b = product(K, solution);
  const File matrix(matrix_text(K, n)), right(column_text(b));
  Teuchos::ParameterList options = options_for(matrix, right);
  const Solved solved(options);
  TEST_ASSERT(has_note(solved.system, "K has constants in its null space"));
  TEST_ASSERT(solved.system.remarks.empty());
  std::vector<double> mean_zero = solution;
  for (double& value : mean_zero) value += 0.5;
  TEST_COMPARE(largest_difference(solved.x, mean_zero), <, 1e-12);
  for (double& value : b) value += 1.0;  // no x gives that
  const File inconsistent(column_text(b));
  const Solved nearest(options_for(matrix, inconsistent));
  TEST_ASSERT(nearest.system.remarks.size() == 1 && says(nearest.system.remarks[0], "left out"));
  TEST_COMPARE(largest_difference(nearest.x, mean_zero), <, 1e-12);
  options.set("null space", false);
  TEST_ASSERT(Solved(options).system.notes.empty());
}

TEUCHOS_UNIT_TEST(preparation, is_the_same_on_any_ranks) {
  Entries K = chain(24);
  K[{3, 20}] = 1e-17;
  K[{0, 0}] = 1e20;
  K.erase({23, 22});
  const File matrix(matrix_text(K, 24)), b(column_text(std::vector<double>(24, 1.0)));
  const Teuchos::ParameterList options = options_for(matrix, b);
  const auto mine = systems::read_system(options, world(), at_once);
  const auto whole = systems::read_system(options, alone());
  const auto of = [](const systems::System& system, const algebra::BlockVector& x) {
    const Vector all = in_file_order(system, x);
    const auto view = all.getLocalViewHost(read_only);
    return std::vector<double>(view.data(), view.data() + view.extent(0));
  };
  if (world()->getRank() == 0) {
    TEST_ASSERT(mine.notes == whole.notes);
  }
  const auto b_mine = of(mine, mine.b), known = of(mine, mine.known);
  if (world()->getRank() == 0) {
    TEST_ASSERT(b_mine == of(whole, whole.b) && known == of(whole, whole.known));
  }
  TEST_EQUALITY(mine.K(0, 0)->getGlobalNumEntries(), whole.K(0, 0)->getGlobalNumEntries());
}

TEUCHOS_UNIT_TEST(preparation, a_row_without_entries_is_told) {
  Entries K = chain(n);
  for (const int column : {1, 2, 3}) K.erase({2, column});
  std::vector<double> b = product(K, solution);
  const File matrix(matrix_text(K, n)), right(column_text(b));
  const auto system = systems::read_system(options_for(matrix, right), alone());
  TEST_EQUALITY(system.remarks.size(), 1u);
  TEST_ASSERT(
      says(system.remarks[0], "row 3 of K has no entries: nothing determines this unknown"));
  b[2] = 1.0;
  const File inconsistent(column_text(b));
  TEST_ASSERT(
      says(refusal([&] { systems::read_system(options_for(matrix, inconsistent), alone()); }),
           "row 3 of K has no entries, but the right-hand side is not zero there"));
}

}  // namespace
