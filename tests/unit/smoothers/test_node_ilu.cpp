#include <Ifpack2_Factory.hpp>
#include <Teuchos_CommHelpers.hpp>
#include <Teuchos_UnitTestHarness.hpp>
#include <functional>
#include <set>

#include "tunica/base/map_of.hpp"
#include "tunica/base/trilinos.hpp"
#include "tunica/multigrid/muelu/cycle.hpp"
#include "tunica/smoothers/node_ilu/node_ilu.hpp"
#include "unit/algebra/distance.hpp"
#include "unit/multigrid/complaint.hpp"
#include "unit/smoothers/dense_sweep.hpp"

namespace {

using namespace tunica;
using algebra::DofLayout;
using smoothers::Precision;
using test::largest_distance;
using test::WallMatrix;

constexpr int no_limit = 100000;

Vector from_zero(const CrsMatrix& K, const DofLayout& numbering, int fill, Precision precision,
                 const Vector& b) {
  const auto factors = smoothers::make_node_ilu(K, numbering, {fill, precision});
  factors->refresh();
  Vector x(b.getMap());
  x.putScalar(7.0);
  factors->smooth_from_zero(1.0, b, x);
  return x;
}

/// ILU(k) of 4×4 blocks on one rank without any art: full matrices, levels for all pairs of nodes.
class DenseIlu {
public:
  DenseIlu(const CrsMatrix& K, int fill) : n_(static_cast<int>(n_local_rows(K)) / 4) {
    level_.assign(n_ * n_, no_limit);
    blocks_.assign(n_ * n_, Block(16, 0.0));
    const auto local = K.getLocalMatrixHost();
    for (int i = 0; i < local.numRows(); ++i) {
      const auto row = local.rowConst(i);
      for (int k = 0; k < row.length; ++k) {
        block(i / 4, row.colidx(k) / 4)[4 * (i % 4) + row.colidx(k) % 4] = row.value(k);
        level(i / 4, row.colidx(k) / 4) = 0;
      }
    }
    for (int i = 0; i < n_; ++i)
      for (int k = 0; k < i; ++k)
        if (level(i, k) <= fill)
          for (int j = k + 1; j < n_; ++j)
            level(i, j) = std::min(level(i, j), level(i, k) + level(k, j) + 1);
    for (int i = 0; i < n_; ++i)
      for (int k = 0; k < i; ++k)
        if (level(i, k) <= fill) eliminate(i, k, fill);
  }

  std::vector<double> solve(std::vector<double> x) const {
    for (int i = 0; i < n_; ++i)
      for (int k = 0; k < i; ++k) subtract(i, k, x);
    for (int i = n_ - 1; i >= 0; --i) {
      for (int k = i + 1; k < n_; ++k) subtract(i, k, x);
      const auto y = test::solve_dense(blocks_[i * n_ + i], {&x[4 * i], &x[4 * i] + 4});
      std::copy(y.begin(), y.end(), &x[4 * i]);
    }
    return x;
  }

private:
  using Block = std::vector<double>;  // row by row

  int& level(int i, int j) { return level_[i * n_ + j]; }
  Block& block(int i, int j) { return blocks_[i * n_ + j]; }

  void eliminate(int i, int k, int fill) {
    Block pivot(16), &L = block(i, k);
    for (int a = 0; a < 4; ++a)
      for (int b = 0; b < 4; ++b) pivot[4 * a + b] = block(k, k)[4 * b + a];
    for (int a = 0; a < 4; ++a) {
      const auto row = test::solve_dense(pivot, {&L[4 * a], &L[4 * a] + 4});
      std::copy(row.begin(), row.end(), &L[4 * a]);
    }
    for (int j = k + 1; j < n_; ++j)
      if (level(k, j) <= fill && level(i, j) <= fill)
        for (int a = 0; a < 4; ++a)
          for (int b = 0; b < 4; ++b)
            for (int c = 0; c < 4; ++c)
              block(i, j)[4 * a + b] -= L[4 * a + c] * block(k, j)[4 * c + b];
  }
  void subtract(int i, int k, std::vector<double>& x) const {
    for (int a = 0; a < 4; ++a)
      for (int b = 0; b < 4; ++b) x[4 * i + a] -= blocks_[i * n_ + k][4 * a + b] * x[4 * k + b];
  }

  int n_;
  std::vector<int> level_;
  std::vector<Block> blocks_;
};

TEUCHOS_UNIT_TEST(node_ilu, is_the_incomplete_elimination_of_full_blocks) {
  const WallMatrix wall(test::alone());
  const Vector b = wall.scattered(1);
  Vector before(b.getMap());
  for (const int fill : {0, 1, 2}) {
    const auto values = b.getData();
    const auto solution = DenseIlu(*wall.K(), fill).solve({values.begin(), values.end()});
    Vector expected(b.getMap(), Teuchos::arrayViewFromVector(solution));
    for (const auto& [precision, tolerance] :
         {std::pair{Precision::full, 1e-9}, std::pair{Precision::single, 1e-3},
          std::pair{Precision::half, 3e-2}})
      TEST_COMPARE(largest_distance(from_zero(*wall.K(), {}, fill, precision, b), expected), <,
                   tolerance);
    TEST_COMPARE(largest_distance(before, expected), >, 1e-3);  // fill does change something
    before.assign(expected);
  }
}

/// With all fill both are exact for the rows of a rank and those that they reach.
TEUCHOS_UNIT_TEST(node_ilu, takes_the_rows_of_other_ranks_as_restricted_schwarz_does) {
  const WallMatrix wall;
  const Teuchos::RCP<const RowMatrix> rows = wall.K();
  const auto schwarz = Ifpack2::Factory::create<RowMatrix>("SCHWARZ", rows);
  Teuchos::ParameterList list;
  list.set("schwarz: inner preconditioner name", "DENSE");
  list.set("schwarz: overlap level", 1).set("schwarz: combine mode", "ZERO");
  schwarz->setParameters(list);
  schwarz->initialize();
  schwarz->compute();
  const Vector b = wall.scattered(1);
  Vector expected(b.getMap());
  schwarz->apply(b, expected);
  TEST_COMPARE(largest_distance(from_zero(*wall.K(), {}, no_limit, Precision::full, b), expected),
               <, 1e-7);
}

TEUCHOS_UNIT_TEST(node_ilu, smooths_by_the_solution_for_the_residual) {
  const WallMatrix wall;
  const Vector b = wall.scattered(1), start = wall.scattered(2);
  for (const Precision precision : {Precision::full, Precision::single, Precision::half}) {
    const bool is_full = precision == Precision::full;
    const auto factors = smoothers::make_node_ilu(*wall.K(), {}, {0, precision});
    factors->refresh();
    Vector r(b, Teuchos::Copy), expected(b.getMap()), x(start, Teuchos::Copy);
    wall.K()->apply(start, r, Teuchos::NO_TRANS, -1.0, 1.0);
    factors->smooth_from_zero(0.7, r, expected);
    expected.update(1.0, start, 1.0);
    factors->smooth(0.7, b, x);
    TEST_COMPARE(largest_distance(x, expected), <, is_full ? 1e-10 : 1e-3);
    Vector found(b.getMap());
    factors->residual(b, start, found);
    TEST_COMPARE(largest_distance(found, r), <, is_full ? 1e-12 : 1e-5);
  }
}

/// The rows and columns of a matrix on one rank that have a number, with these numbers.
template <class Number>
Teuchos::RCP<CrsMatrix> part_of(const CrsMatrix& K, const Number& number) {
  std::vector<GlobalOrdinal> numbers;
  const auto local = K.getLocalMatrixHost();
  for (int i = 0; i < local.numRows(); ++i)
    if (number(i) >= 0) numbers.push_back(number(i));
  const auto map = map_of(numbers, K.getComm());
  const auto part = Teuchos::rcp(new CrsMatrix(map, K.getGlobalMaxNumRowEntries()));
  for (int i = 0; i < local.numRows(); ++i) {
    if (number(i) < 0) continue;
    const auto row = local.rowConst(i);
    for (int k = 0; k < row.length; ++k) {
      const GlobalOrdinal column = number(row.colidx(k));
      const Scalar value = row.value(k);
      if (column >= 0) part->insertGlobalValues(number(i), 1, &value, &column);
    }
  }
  part->fillComplete();
  return part;
}

TEUCHOS_UNIT_TEST(node_ilu, nodes_may_lack_unknowns_or_lie_in_a_plane) {
  const WallMatrix wall(test::alone());
  const auto few_pressures = [](int i) { return i % 4 == 3 && i / 4 % 3 != 0 ? -1 : i; };
  const auto flat = [](int i) { return i % 4 == 2 ? -1 : i / 4 * 3 + std::min(i % 4, 2); };
  for (const auto& [K, components] :
       {std::pair{part_of(*wall.K(), few_pressures), 3}, std::pair{part_of(*wall.K(), flat), 2}}) {
    const DofLayout numbering({components, 1});
    Vector x(K->getRowMap()), b(x.getMap());
    x.randomize();
    K->apply(x, b);
    TEST_COMPARE(largest_distance(from_zero(*K, numbering, no_limit, Precision::full, b), x), <,
                 1e-7);
  }
}

/// The matrix without the unknowns that are not in; or with the unit matrix in their place.
Teuchos::RCP<CrsMatrix> without(const CrsMatrix& K, const std::function<bool(GlobalOrdinal)>& is_in,
                                bool has_unit_rows) {
  std::vector<GlobalOrdinal> rows;
  for (const GlobalOrdinal row : global_numbers(*K.getRowMap()))
    if (has_unit_rows || is_in(row)) rows.push_back(row);
  const auto part =
      Teuchos::rcp(new CrsMatrix(map_of(rows, K.getComm()), K.getGlobalMaxNumRowEntries()));
  const auto local = K.getLocalMatrixHost();
  for (const GlobalOrdinal row : rows) {
    const auto entries = local.rowConst(K.getRowMap()->getLocalElement(row));
    for (int k = 0; k < entries.length; ++k) {
      const GlobalOrdinal column = K.getColMap()->getGlobalElement(entries.colidx(k));
      const bool is_unit = row == column && !is_in(row);
      const Scalar value = is_unit ? 1.0 : entries.value(k);
      if (is_unit || (is_in(row) && is_in(column)))
        part->insertGlobalValues(row, 1, &value, &column);
    }
  }
  part->fillComplete();
  return part;
}

// Every third node has a pressure alone: what is left out of its blocks must not matter.
TEUCHOS_UNIT_TEST(node_ilu, a_scalar_alone_is_as_with_unit_rows_for_the_rest) {
  const WallMatrix wall;
  const auto is_in = [](GlobalOrdinal i) { return i % 4 == 3 || i / 4 % 3 != 0; };
  const auto K = without(*wall.K(), is_in, false), padded = without(*wall.K(), is_in, true);
  const Import to_padded(K->getRowMap(), padded->getRowMap());
  const auto filled_up = [&](const Vector& part) {
    Vector whole(padded->getRowMap());
    whole.doImport(part, to_padded, insert);
    return whole;
  };
  Vector b(K->getRowMap()), start(K->getRowMap());
  b.doImport(wall.scattered(1), Import(wall.K()->getRowMap(), K->getRowMap()), insert);
  start.doImport(wall.scattered(2), Import(wall.K()->getRowMap(), K->getRowMap()), insert);
  for (const Precision precision : {Precision::full, Precision::single, Precision::half})
    for (const int fill : {0, 1, 2}) {
      const auto factors = smoothers::make_node_ilu(*K, {}, {fill, precision});
      const auto reference = smoothers::make_node_ilu(*padded, {}, {fill, precision});
      factors->refresh();
      reference->refresh();
      TEST_COMPARE(factors->bytes(), <, reference->bytes());
      Vector x(start, Teuchos::Copy), expected = filled_up(start);
      // Where eight digits are kept, round-off decides which way some of them go.
      const double tolerance = precision == Precision::full     ? 1e-11
                               : precision == Precision::single ? 1e-5
                                                                : 1e-2;
      factors->smooth(0.7, b, x);
      reference->smooth(0.7, filled_up(b), expected);
      TEST_COMPARE(largest_distance(filled_up(x), expected), <, tolerance);
      factors->smooth_from_zero(1.0, b, x);
      reference->smooth_from_zero(1.0, filled_up(b), expected);
      TEST_COMPARE(largest_distance(filled_up(x), expected), <, tolerance);
    }
}

TEUCHOS_UNIT_TEST(node_ilu, forgets_what_was_no_number) {
  const WallMatrix wall(test::alone());
  const auto K = part_of(*wall.K(), [](int i) { return i % 4 == 3 && i / 4 % 3 != 0 ? -1 : i; });
  const auto factors = smoothers::make_node_ilu(*K, {}, {});
  factors->refresh();
  std::vector<Vector> x;
  for (const double value : {1.0, Teuchos::ScalarTraits<double>::nan(), 1.0}) {
    Vector b(K->getRowMap());
    b.putScalar(value);
    factors->smooth(0.7, b, x.emplace_back(b.getMap()));
  }
  TEST_EQUALITY(largest_distance(x[2], x[0]), 0.0);
}

TEUCHOS_UNIT_TEST(node_ilu, ranks_may_have_no_rows) {
  const WallMatrix wall;
  const Comm& comm = *wall.K()->getComm();
  std::vector<GlobalOrdinal> numbers;
  if (comm.getRank() == comm.getSize() - 1)
    for (GlobalOrdinal i = 0; i < wall.K()->getRowMap()->getMaxAllGlobalIndex() + 1; ++i)
      numbers.push_back(i);
  const auto map = map_of(numbers, wall.K()->getComm());
  CrsMatrix K(map, wall.K()->getGlobalMaxNumRowEntries());
  K.doImport(*wall.K(), Import(wall.K()->getRowMap(), map), insert);
  K.fillComplete();
  Vector x(map), b(map);
  x.randomize();
  K.apply(x, b);
  TEST_COMPARE(largest_distance(from_zero(K, {}, no_limit, Precision::full, b), x), <, 1e-7);
}

// Elimination of node 0 couples 1 and 2, which only 3 reaches. Where 1 is host of 3, they have
// their columns in common, and the factors are complete.

TEUCHOS_UNIT_TEST(node_ilu, nodes_share_the_columns_of_their_host) {
  const std::vector<std::set<GlobalOrdinal>> coupled{{0, 1, 2}, {0, 1, 3}, {0, 2, 3}, {1, 2, 3}};
  const auto numbers = [](GlobalOrdinal node) {  // the last has a scalar only
    std::vector<GlobalOrdinal> all;
    for (GlobalOrdinal i = node == 3 ? 3 : 0; i < 4; ++i) all.push_back(4 * node + i);
    return all;
  };
  std::vector<GlobalOrdinal> rows;
  for (GlobalOrdinal node = 0; node < 4; ++node)
    for (const GlobalOrdinal row : numbers(node)) rows.push_back(row);
  CrsMatrix K(map_of(rows, test::alone()), 16);
  for (const GlobalOrdinal row : rows)
    for (const GlobalOrdinal node : coupled[row / 4])
      for (const GlobalOrdinal column : numbers(node))
        K.insertGlobalValues(
            row, Teuchos::tuple<GlobalOrdinal>(column),
            Teuchos::tuple(row == column ? 9.0 : test::scatter(16.0 * row + column)));
  K.fillComplete();
  const auto hosts = Teuchos::rcp(new Vector(map_of({0, 1, 2, 3}, test::alone())));
  for (int node = 0; node < 4; ++node) hosts->replaceLocalValue(node, node == 3 ? 1 : node);
  Vector x(K.getRowMap()), b(K.getRowMap()), found(K.getRowMap());
  for (std::size_t i = 0; i < rows.size(); ++i)
    x.replaceLocalValue(static_cast<int>(i), test::scatter(i));
  K.apply(x, b);
  for (const bool has_hosts : {true, false}) {
    smoothers::NodeIluOptions options{0, Precision::full};
    if (has_hosts) options.hosts = hosts;
    const auto factors = smoothers::make_node_ilu(K, {}, options);
    factors->refresh();
    factors->smooth_from_zero(1.0, b, found);
    if (has_hosts)
      TEST_COMPARE(largest_distance(found, x), <, 1e-13)
    else
      TEST_COMPARE(largest_distance(found, x), >, 1e-4)
  }
}

TEUCHOS_UNIT_TEST(nodal_ilu_smoother, does_what_its_list_says) {
  const WallMatrix wall;
  Teuchos::ParameterList list = multigrid::mixed_cycle_list(2);
  list.sublist("Factories")
      .sublist("Sweeps")
      .set("damping", 0.7)
      .set("fill", 1)
      .set("precision", "double");
  list.sublist("Hierarchy").set("max levels", 1).sublist("All").set("CoarseSolver", "Sweeps");
  const multigrid::Cycle cycle(
      wall.K(), Teuchos::rcp(new multigrid::MixedCoarsening(*wall.jacobian.K.space())), list);
  const auto factors = smoothers::make_node_ilu(*wall.K(), {}, {1, Precision::full});
  factors->refresh();
  const Vector b = wall.scattered(1);
  Vector x = wall.scattered(2), expected(b.getMap());
  cycle.apply(b, x);
  factors->smooth_from_zero(0.7, b, expected);
  factors->smooth(0.7, b, expected);
  TEST_COMPARE(largest_distance(x, expected), <, 1e-12);
}

TEUCHOS_UNIT_TEST(nodal_ilu_smoother, three_sweeps_are_chebyshevs_polynomial) {
  const WallMatrix wall;
  if (wall.K()->getComm()->getSize() > 1) return;  // whose factors are exact within ranks alone
  Teuchos::ParameterList list = multigrid::mixed_cycle_list(3, "chebyshev");
  list.sublist("Factories")
      .sublist("Sweeps")
      .set("fill", 100)  // exact factors: all eigenvalues are 1
      .set("spectral bound", 0.0)
      .set("precision", "double");
  list.sublist("Hierarchy").set("max levels", 1).sublist("All").set("CoarseSolver", "Sweeps");
  const multigrid::Cycle cycle(
      wall.K(), Teuchos::rcp(new multigrid::MixedCoarsening(*wall.jacobian.K.space())), list);
  const Vector z = wall.scattered(1);
  Vector b(z.getMap()), x(z.getMap()), expected(z, Teuchos::Copy);
  wall.K()->apply(z, b);
  cycle.apply(b, x);
  const auto T3 = [](double t) { return 4.0 * t * t * t - 3.0 * t; };
  // What is left of an error at 1, for the interval from 0.55 to 1.25: its middle 0.9, half 0.35.
  expected.scale(1.0 - T3((0.9 - 1.0) / 0.35) / T3(0.9 / 0.35));
  TEST_COMPARE(largest_distance(x, expected), <, 1e-9);
}

TEUCHOS_UNIT_TEST(nodal_ilu_smoother, slips_in_its_list_are_refused) {
  const auto refusal = [](const auto& slip) {
    Teuchos::ParameterList list = multigrid::mixed_cycle_list(1);
    slip(list.sublist("Factories").sublist("Sweeps"));
    return test::complaint([&] { multigrid::check_cycle_list(list); });
  };
  for (const auto& [text, part] :
       {std::pair{refusal([](auto& s) { s.set("precision", "quarter"); }), "\"single\""},
        std::pair{refusal([](auto& s) { s.set("polynomial", "legendre"); }), "\"chebyshev\""},
        std::pair{refusal([](auto& s) { s.set("sweeps", 0); }), "\"sweeps\""},
        std::pair{refusal([](auto& s) { s.set("fill", -1); }), "\"fill\""},
        std::pair{refusal([](auto& s) { s.set("swept", 1); }), "\"swept\""}})
    TEST_INEQUALITY(text.find(part), std::string::npos);
}

TEUCHOS_UNIT_TEST(node_ilu, a_singular_node_of_one_rank_is_told_on_all) {
  WallMatrix wall;
  const auto factors = smoothers::make_node_ilu(*wall.K(), {}, {});
  factors->refresh();
  const Comm& comm = *wall.K()->getComm();
  if (comm.getRank() == comm.getSize() - 1) {
    const auto local = wall.K()->getLocalMatrixHost();
    for (int i = 0; i < 4; ++i) {
      auto row = local.row(i);
      for (int k = 0; k < row.length; ++k) row.value(k) = 0.0;
    }
  }
  const std::string text = test::complaint([&] { factors->refresh(); });
  GlobalOrdinal node = wall.K()->getRowMap()->getGlobalElement(0) / 4;
  Teuchos::broadcast<int, GlobalOrdinal>(comm, comm.getSize() - 1, &node);
  const std::string expected = "node " + std::to_string(node) + " of " +
                               std::to_string(wall.K()->getGlobalNumRows()) + " unknowns cannot";
  TEST_INEQUALITY(text.find(expected), std::string::npos);
}

}  // namespace
