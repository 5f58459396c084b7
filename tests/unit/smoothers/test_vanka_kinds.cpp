#include <Teuchos_UnitTestHarness.hpp>
#include <set>

#include "tunica/base/map_of.hpp"
#include "tunica/base/trilinos.hpp"
#include "tunica/smoothers/vanka/vanka.hpp"
#include "unit/algebra/distance.hpp"
#include "unit/smoothers/dense_sweep.hpp"

namespace {

using namespace tunica;
using smoothers::VankaOptions;
using smoothers::VankaPatches;
using test::largest_distance;
using test::WallMatrix;

VankaOptions of_kind(const std::string& patch) {
  VankaOptions options;
  options.patch = patch;
  options.order = "forward";
  return options;
}

VankaPatches patches_of(const CrsMatrix& K, const std::string& kind,
                        const Teuchos::RCP<const Vector>& hosts = Teuchos::null) {
  const auto mixed = smoothers::mixed_rows(K, {}, hosts);
  return kind == "diagonal" ? smoothers::make_nodal_patches(K, mixed)
                            : smoothers::make_pair_patches(K, mixed);
}

Vector smoothed(const CrsMatrix& K, const VankaOptions& options, const Vector& b,
                const Vector& start, const Teuchos::RCP<const Vector>& hosts = Teuchos::null) {
  const auto smoother = smoothers::make_vanka(K, smoothers::mixed_rows(K, {}, hosts), options);
  smoother->refresh();
  Vector x(start, Teuchos::Copy);
  smoother->smooth(b, x);
  return x;
}

/// One rank: the entries of a row, own columns only and by their rows.
double entry(const CrsMatrix& K, int i, int j) {
  const auto row = K.getLocalMatrixHost().rowConst(i);
  for (int k = 0; k < row.length; ++k)
    if (row.colidx(k) == j) return row.value(k);
  return 0.0;
}

/// i, j: numbers of unknowns.
bool is_kept(const std::string& kind, GlobalOrdinal i, GlobalOrdinal j) {
  return kind != "diagonal" || i % 4 == 3 || j % 4 == 3 || i / 4 == j / 4;
}

/// The forward sweep by LAPACK, on one rank: with "diagonal", without the entries of a patch that
/// couple velocities of two nodes.
Vector dense_sweep(const CrsMatrix& K, const std::string& kind, const VankaPatches& patches,
                   const Vector& b, Vector x) {
  Vector r(b.getMap());
  const auto relax = [&](const std::vector<int>& rows) {
    r.assign(b);
    K.apply(x, r, Teuchos::NO_TRANS, -1.0, 1.0);
    const auto values = r.getData();
    std::vector<double> M, rest;
    for (const int i : rows) {
      rest.push_back(values[i]);
      for (const int j : rows) {
        const Map& numbers = *K.getRowMap();
        const bool kept = is_kept(kind, numbers.getGlobalElement(i), numbers.getGlobalElement(j));
        M.push_back(kept ? entry(K, i, j) : 0.0);
      }
    }
    const auto moves = test::solve_dense(M, rest);
    for (std::size_t a = 0; a < rows.size(); ++a) x.sumIntoLocalValue(rows[a], moves[a]);
  };
  for (const int row : patches.uncovered_rows) relax({row});
  for (int p = 0; p < patches.n_patches(); ++p)
    relax({patches.rows.begin() + static_cast<std::ptrdiff_t>(patches.start[p]),
           patches.rows.begin() + static_cast<std::ptrdiff_t>(patches.start[p + 1])});
  return x;
}

TEUCHOS_UNIT_TEST(vanka_kinds, each_is_a_loop_over_its_dense_patches) {
  const WallMatrix wall(test::alone());
  const Vector b = wall.scattered(1), start = wall.scattered(2);
  for (const std::string kind : {"diagonal", "node pair"}) {
    const Vector expected =
        dense_sweep(*wall.K(), kind, patches_of(*wall.K(), kind), b, Vector(start, Teuchos::Copy));
    VankaOptions options = of_kind(kind);
    TEST_COMPARE(largest_distance(smoothed(*wall.K(), options, b, start), expected), <, 1e-10);
    options.is_single = true;
    TEST_COMPARE(largest_distance(smoothed(*wall.K(), options, b, start), expected), <, 1e-5);
  }
}

TEUCHOS_UNIT_TEST(vanka_kinds, the_exact_solution_stays) {
  const WallMatrix wall;
  const Vector x = wall.scattered(2);
  Vector b(x.getMap());
  wall.K()->apply(x, b);
  for (const std::string kind : {"diagonal", "node pair"})
    for (const bool is_additive : {false, true}) {
      VankaOptions options = of_kind(kind);
      options.order = "symmetric";
      options.is_additive = is_additive;
      TEST_COMPARE(largest_distance(smoothed(*wall.K(), options, b, x), x), <, 1e-10);
    }
}

TEUCHOS_UNIT_TEST(vanka_kinds, patches_cover_all_but_the_lone_rows) {
  const WallMatrix wall;
  const auto lone =
      smoothers::make_vanka_patches(*wall.K(), smoothers::mixed_rows(*wall.K(), {}).is_pressure)
          .uncovered_rows;
  for (const std::string kind : {"diagonal", "node pair"}) {
    const VankaPatches patches = patches_of(*wall.K(), kind);
    std::vector<char> is_covered(n_local_rows(*wall.K()), 0);
    for (const int row : patches.rows) is_covered[row] = 1;
    std::vector<int> others;
    for (std::size_t i = 0; i < is_covered.size(); ++i)
      if (!is_covered[i]) others.push_back(static_cast<int>(i));
    TEST_ASSERT(others == lone);
    TEST_ASSERT(patches.uncovered_rows == lone);
  }
  TEST_COMPARE(patches_of(*wall.K(), "node pair").largest(), <=, 8);
}

TEUCHOS_UNIT_TEST(vanka_kinds, need_less_memory_than_full_patches) {
  const WallMatrix wall(test::alone());
  const auto bytes = [&](const std::string& kind) {
    const auto smoother =
        smoothers::make_vanka(*wall.K(), smoothers::mixed_rows(*wall.K(), {}), of_kind(kind));
    smoother->refresh();
    return smoother->bytes();
  };
  TEST_COMPARE(bytes("diagonal"), <, 0.5 * bytes("full"));
  TEST_COMPARE(bytes("node pair"), <, bytes("full"));
}

/// Rows of B2 reach other velocities after an entry of theirs has become zero, or ceased to be.
TEUCHOS_UNIT_TEST(vanka_kinds, refresh_is_as_good_as_a_new_smoother_whatever_becomes_zero) {
  const WallMatrix wall;
  CrsMatrix& K = *wall.K();
  const Vector b = wall.scattered(1), start = wall.scattered(2);
  for (const std::string kind : {"full", "diagonal", "node pair"}) {
    const auto smoother = smoothers::make_vanka(K, smoothers::mixed_rows(K, {}), of_kind(kind));
    smoother->refresh();
    for (const double factor : {0.0, 1.0}) {
      K.resumeFill();
      {
        auto row = K.getLocalMatrixHost().row(3);
        for (int k = 0; k < row.length; ++k)
          if (row.colidx(k) % 4 != 3 && row.colidx(k) / 4 % 2 == 1)
            row.value(k) = factor * (0.1 + 0.01 * k);
      }
      K.fillComplete(K.getDomainMap(), K.getRangeMap());
      smoother->refresh();
      Vector x(start, Teuchos::Copy);
      smoother->smooth(b, x);
      TEST_EQUALITY(largest_distance(x, smoothed(K, of_kind(kind), b, start)), 0.0);
    }
  }
}

/// The wall's matrix on one rank, where pressures of every third node have numbers apart from the
/// velocities: all there are ("moved"), or one more beside its own ("added").
struct SplitMatrix {
  static constexpr GlobalOrdinal apart = 1000;  ///< what is added to the number of the node

  SplitMatrix(const CrsMatrix& wall, bool is_added) {
    const int n = static_cast<int>(n_local_rows(wall));
    const auto number = [&](int row) {
      return GlobalOrdinal(row) + (!is_added && row % 12 == 3 ? 4 * apart : 0);
    };
    std::vector<GlobalOrdinal> rows, nodes;
    for (int row = 0; row < n; ++row)
      if (number(row) == row) rows.push_back(row);
    for (int row = 3; row < n; row += 12) rows.push_back(row + 4 * apart);
    for (int node = 0; node < n / 4; ++node) nodes.push_back(node);
    for (int node = 0; node < n / 4; node += 3) nodes.push_back(node + apart);
    K = Teuchos::rcp(new CrsMatrix(map_of(rows, test::alone()), n));
    const auto insert_entry = [&](GlobalOrdinal row, GlobalOrdinal column, double value) {
      K->insertGlobalValues(row, Teuchos::tuple(column), Teuchos::tuple(value));
    };
    for (int i = 0; i < n; ++i) {
      const auto row = wall.getLocalMatrixHost().rowConst(i);
      for (int k = 0; k < row.length; ++k) {
        const int j = row.colidx(k);
        insert_entry(number(i), number(j), row.value(k));
        if (!is_added) continue;
        // It reaches the same velocities and its like, otherwise.
        const bool has_row = i % 12 == 3, has_column = j % 12 == 3;
        if (has_row && has_column)
          insert_entry(i + 4 * apart, j + 4 * apart, 2.0 * row.value(k));
        else if (has_row && j % 4 != 3)
          insert_entry(i + 4 * apart, j, test::scatter(i + 100.0 * j) * row.value(k));
        else if (has_column && i % 4 != 3)
          insert_entry(i, j + 4 * apart, test::scatter(100.0 * i + j) * row.value(k));
      }
    }
    K->fillComplete();
    hosts = Teuchos::rcp(new Vector(map_of(nodes, test::alone())));
    for (std::size_t k = 0; k < nodes.size(); ++k)
      hosts->replaceLocalValue(static_cast<int>(k),
                               nodes[k] < apart ? -1.0 : static_cast<double>(nodes[k] - apart));
  }

  /// Entries of the rows that the wall has, too; others from their numbers.
  Vector of_wall(const Vector& x) const {
    Vector all(K->getRowMap());
    for (int i = 0; i < static_cast<int>(n_local_rows(*K)); ++i) {
      const GlobalOrdinal number = K->getRowMap()->getGlobalElement(i);
      all.replaceLocalValue(i, x.getData()[static_cast<int>(number % (4 * apart))]);
    }
    return all;
  }

  Teuchos::RCP<CrsMatrix> K;
  Teuchos::RCP<Vector> hosts;
};

TEUCHOS_UNIT_TEST(vanka_kinds, pressures_stand_where_their_hosts_do) {
  const WallMatrix wall(test::alone());
  const SplitMatrix split(*wall.K(), false);
  const Vector b = wall.scattered(1), start = wall.scattered(2);
  for (const std::string kind : {"diagonal", "node pair"})
    for (const bool is_additive : {false, true}) {
      if (kind == "diagonal" && !is_additive) continue;  // its patches are in another order
      VankaOptions options = of_kind(kind);
      options.is_additive = is_additive;
      const Vector expected = split.of_wall(smoothed(*wall.K(), options, b, start));
      const Vector found =
          smoothed(*split.K, options, split.of_wall(b), split.of_wall(start), split.hosts);
      TEST_COMPARE(largest_distance(found, expected), <, 1e-11);
    }
}

TEUCHOS_UNIT_TEST(vanka_kinds, nodes_may_have_two_pressures) {
  const WallMatrix wall(test::alone());
  const SplitMatrix split(*wall.K(), true);
  const Vector b = split.of_wall(wall.scattered(1)), start = split.of_wall(wall.scattered(2));
  const VankaPatches pairs = patches_of(*split.K, "node pair", split.hosts);
  TEST_COMPARE(pairs.largest(), >, 8);
  TEST_COMPARE(pairs.largest(), <=, 10);
  TEST_EQUALITY(pairs.n_patches(), patches_of(*wall.K(), "node pair").n_patches());
  TEST_EQUALITY(patches_of(*split.K, "diagonal", split.hosts).n_patches(),
                static_cast<int>(split.hosts->getLocalLength()));
  for (const std::string kind : {"diagonal", "node pair"}) {
    const VankaPatches patches = patches_of(*split.K, kind, split.hosts);
    const Vector expected = dense_sweep(*split.K, kind, patches, b, Vector(start, Teuchos::Copy));
    const Vector found = smoothed(*split.K, of_kind(kind), b, start, split.hosts);
    TEST_COMPARE(largest_distance(found, expected), <, 1e-9);
  }
}

/// Where nobody knows that they do, velocities are with the pressures that reach them.
TEUCHOS_UNIT_TEST(vanka_kinds, pairs_of_nodes_without_pressure_cover_all) {
  const WallMatrix wall(test::alone());
  const SplitMatrix split(*wall.K(), false);
  const Vector b = split.of_wall(wall.scattered(1)), start = split.of_wall(wall.scattered(2));
  const VankaPatches patches = patches_of(*split.K, "node pair");
  const std::set<int> covered(patches.rows.begin(), patches.rows.end());
  TEST_EQUALITY(covered.size() + patches.uncovered_rows.size(), n_local_rows(*split.K));
  const Vector expected =
      dense_sweep(*split.K, "node pair", patches, b, Vector(start, Teuchos::Copy));
  TEST_COMPARE(largest_distance(smoothed(*split.K, of_kind("node pair"), b, start), expected), <,
               1e-9);
}

TEUCHOS_UNIT_TEST(vanka_kinds, patches_of_nodes_need_the_nodes) {
  const WallMatrix wall;
  auto mixed = smoothers::mixed_rows(*wall.K(), {});
  const auto refuses = [&](const std::string& kind) {
    TEST_THROW(smoothers::make_vanka(*wall.K(), mixed, of_kind(kind)), std::invalid_argument);
  };
  if (test::world()->getRank() == 0) mixed.place.clear();
  for (const std::string kind : {"diagonal", "node pair"}) refuses(kind);
  if (test::world()->getRank() == 0) mixed.place.assign(mixed.is_pressure.size(), -1);
  refuses("node pair");
}

/// The rows of the matrix itself serve where they are not those of whole nodes.
TEUCHOS_UNIT_TEST(vanka_kinds, full_patches_do_without_whole_nodes) {
  const WallMatrix wall;
  auto mixed = smoothers::mixed_rows(*wall.K(), {});
  const Vector x = wall.scattered(2), start = wall.scattered(3);
  Vector b(x.getMap());
  wall.K()->apply(x, b);
  // One velocity in the role of a pressure: a patch of its own, of which no other has a part.
  mixed.is_pressure[0] = 1;
  const auto smoother = smoothers::make_vanka(*wall.K(), mixed, of_kind("full"));
  smoother->refresh();
  Vector same(x, Teuchos::Copy), moved(start, Teuchos::Copy);
  smoother->smooth(b, same);
  TEST_COMPARE(largest_distance(same, x), <, 1e-10);
  smoother->smooth(b, moved);
  TEST_COMPARE(largest_distance(moved, start), >, 0.01);
  // Its bytes tell that it keeps no copy of the rows.
  const auto nodal =
      smoothers::make_vanka(*wall.K(), smoothers::mixed_rows(*wall.K(), {}), of_kind("full"));
  TEST_COMPARE(smoother->bytes(), <, nodal->bytes());
}

}  // namespace
