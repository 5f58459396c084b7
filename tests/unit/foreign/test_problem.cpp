#include <Teuchos_UnitTestHarness.hpp>
#include <Tpetra_Core.hpp>
#include <cmath>
#include <map>

#include "tunica/base/error.hpp"
#include "tunica/foreign/problem.hpp"
#include "unit/multigrid/complaint.hpp"

namespace {

using namespace tunica;

using Entries = std::map<std::pair<long long, long long>, double>;
using Numbers = std::vector<double>;

constexpr long long n = 24;

/// K = tridiag(-1, 2, -1) with prescribed values at both ends, as rows whose columns stay.
Entries chain(double factor) {
  Entries K;
  for (long long i = 1; i + 1 < n; ++i) {
    K[{i, i}] = 2.0 * factor;
    K[{i, i - 1}] = K[{i, i + 1}] = -factor;
  }
  K[{0, 0}] = K[{n - 1, n - 1}] = 1.0;
  return K;
}
Numbers wave(double phase) {
  Numbers x;
  for (long long k = 0; k < n; ++k) x.push_back(std::sin(0.7 * static_cast<double>(k) + phase));
  return x;
}

/// The rows of a rank, in unequal portions.
struct Rows {
  explicit Rows(const Entries& K) {
    const int rank = comm->getRank(), ranks = comm->getSize();
    first = ranks == 1 ? 0 : n * rank * rank / (ranks * ranks);
    last = ranks == 1 ? n : n * (rank + 1) * (rank + 1) / (ranks * ranks);
    for (const auto& [place, value] : K) {
      if (place.first < first || place.first >= last) continue;
      while (static_cast<long long>(offsets.size()) <= place.first - first)
        offsets.push_back(static_cast<long long>(columns.size()));
      columns.push_back(place.second);
      values.push_back(value);
    }
    while (static_cast<long long>(offsets.size()) <= last - first)
      offsets.push_back(static_cast<long long>(columns.size()));
  }
  foreign::OwnRows own() const {
    return {last - first, offsets.data(), columns.data(), values.data()};
  }
  Numbers part(const Numbers& x) const { return {x.begin() + first, x.begin() + last}; }

  CommPtr comm = Tpetra::getDefaultComm();
  long long first, last;
  std::vector<long long> offsets, columns;
  Numbers values;
};

Numbers product(const Entries& K, const Numbers& x) {
  Numbers b(x.size(), 0.0);
  for (const auto& [place, value] : K) b[place.first] += value * x[place.second];
  return b;
}

/// Largest error of the rank's rows of the solution that b = K x has.
double error(foreign::Problem& problem, const Entries& K, const Numbers& x) {
  const Rows rows(K);
  const Numbers b = rows.part(product(K, x)), exact = rows.part(x);
  Numbers found(b.size());
  const foreign::Answer answer = problem.solve(b.data(), found.data());
  double largest = answer.report.is_converged ? 0.0 : 1.0;
  for (std::size_t k = 0; k < found.size(); ++k)
    largest = std::max(largest, std::abs(found[k] - exact[k]));
  return largest;
}

TEUCHOS_UNIT_TEST(problem, rows_of_any_portions_are_solved_with_again_and_again) {
  const Entries K = chain(1.0);
  const Rows rows(K);
  foreign::Problem problem(rows.own(), "", rows.comm);
  TEST_EQUALITY(problem.n_unknowns(), n);
  for (const double phase : {0.0, 1.0, 2.0}) {  // also other prescribed values
    TEST_COMPARE(error(problem, K, wave(phase)), <, 1e-10);
    TEST_COMPARE(problem.residual(), <, 1e-12);
  }
  if (rows.comm->getRank() == 0)
    TEST_ASSERT(problem.notes().find("rows 1 and 24 of K give the values") != std::string::npos);
}

/// Whether all was set up anew for this reason; none: it was not.
bool refreshes(foreign::Problem& problem, const Entries& K, const std::string& reason) {
  return problem.refresh(Rows(K).values.data()) == reason;
}

TEUCHOS_UNIT_TEST(problem, new_values_are_numeric_work_while_they_mean_the_same) {
  const Rows rows(chain(1.0));
  foreign::Problem problem(rows.own(), "", rows.comm);
  for (const double factor : {3.0, 0.25}) {
    const Entries K = chain(factor);
    TEST_ASSERT(refreshes(problem, K, ""));
    TEST_COMPARE(error(problem, K, wave(1.0)), <, 1e-10);
  }
}

TEUCHOS_UNIT_TEST(problem, other_prescribed_values_are_found_anew) {
  Entries K = chain(1.0);
  const Rows rows(K);
  foreign::Problem problem(rows.own(), "", rows.comm);
  K[{7, 6}] = K[{7, 8}] = 0.0;  // x_7 is known, too
  TEST_ASSERT(refreshes(problem, K, "rows that had couplings give values"));
  TEST_COMPARE(error(problem, K, wave(1.0)), <, 1e-10);
  K = chain(1.0);
  TEST_ASSERT(refreshes(problem, K, "rows that gave values have couplings"));
  TEST_COMPARE(error(problem, K, wave(2.0)), <, 1e-10);
}

TEUCHOS_UNIT_TEST(problem, a_null_space_that_comes_is_found) {
  Entries K = chain(1.0);
  K[{0, 1}] = K[{n - 1, n - 2}] = -1e-3;
  const Rows rows(K);
  foreign::Problem problem(rows.own(), "", rows.comm);
  K[{0, 1}] = K[{n - 1, n - 2}] = -1.0;  // no end is held
  TEST_ASSERT(refreshes(problem, K, "the matrix has other constants in its null space"));
  Numbers x = wave(1.0);
  double mean = 0.0;
  for (const double value : x) mean += value / static_cast<double>(n);
  for (double& value : x) value -= mean;
  TEST_COMPARE(error(problem, K, x), <, 1e-9);
}

TEUCHOS_UNIT_TEST(problem, what_is_left_out_counts_in_the_residual) {
  // Entries of 1e-6 are left out of what is factored, and solved for by refinement.
  Entries K = chain(1.0);
  for (long long i = 1; i < 8; ++i) K[{i, i + 12}] = K[{i + 12, i}] = 1e-6;
  const std::string settings =
      "<ParameterList name=\"Case\"><ParameterList name=\"System\">"
      "<Parameter name=\"negligible\" type=\"double\" value=\"1e-4\"/></ParameterList>"
      "<ParameterList name=\"Solvers\"><Parameter name=\"tolerance\" type=\"double\" "
      "value=\"1e-12\"/></ParameterList></ParameterList>";
  const Rows rows(K);
  foreign::Problem problem(rows.own(), settings, rows.comm);
  TEST_COMPARE(error(problem, K, wave(0.0)), <, 1e-9);
  TEST_COMPARE(problem.residual(), <, 1e-11);
}

TEUCHOS_UNIT_TEST(problem, the_case_in_use_solves_the_same) {
  const Entries K = chain(1.0);
  const Rows rows(K);
  foreign::Problem problem(rows.own(), "", rows.comm);
  foreign::Problem again(rows.own(), problem.case_in_use(), rows.comm);
  TEST_EQUALITY(again.setting(), problem.setting());
  TEST_COMPARE(error(again, K, wave(0.0)), <, 1e-10);
}

TEUCHOS_UNIT_TEST(problem, what_does_not_fit_is_told_to_all_ranks) {
  Rows rows(chain(1.0));
  const auto refused = [&](const std::string& settings) {
    return test::complaint<Error>([&] { foreign::Problem(rows.own(), settings, rows.comm); });
  };
  TEST_ASSERT(refused("<ParameterList name=\"Case\"><ParameterList name=\"System\">"
                      "<Parameter name=\"ordr\" type=\"string\" value=\"by node\"/>"
                      "</ParameterList></ParameterList>")
                  .find("order") != std::string::npos);
  TEST_ASSERT(refused("no such file.xml").find("there is no such file") != std::string::npos);
  if (!rows.columns.empty()) rows.columns.back() = n;
  TEST_ASSERT(refused("").find("column 24, expected 0 to 23") != std::string::npos);
  if (!rows.columns.empty()) rows.columns.back() = n - 1;
  if (!rows.values.empty()) rows.values.front() = std::nan("");
  TEST_ASSERT(refused("").find("values[0] is not a finite number") != std::string::npos);
}

}  // namespace
