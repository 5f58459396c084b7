#include <Teuchos_UnitTestHarness.hpp>

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

VankaPatches patches_of(const CrsMatrix& K, const std::string& kind) {
  const auto is_pressure = smoothers::scalar_rows(K, {});
  return kind == "diagonal" ? smoothers::make_nodal_patches(K, is_pressure)
                            : smoothers::make_pair_patches(K, is_pressure);
}

Vector smoothed(const CrsMatrix& K, const VankaOptions& options, const Vector& b,
                const Vector& start) {
  const auto smoother = smoothers::make_vanka(K, smoothers::scalar_rows(K, {}), options);
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

bool is_kept(const std::string& kind, int i, int j) {
  return kind != "diagonal" || i % 4 == 3 || j % 4 == 3 || i / 4 == j / 4;
}

/// The forward sweep by LAPACK, on one rank: with "diagonal", without the entries of a patch that
/// couple velocities of two nodes.
Vector dense_sweep(const CrsMatrix& K, const std::string& kind, const Vector& b, Vector x) {
  const VankaPatches patches = patches_of(K, kind);
  Vector r(b.getMap());
  const auto relax = [&](const std::vector<int>& rows) {
    r.assign(b);
    K.apply(x, r, Teuchos::NO_TRANS, -1.0, 1.0);
    const auto values = r.getData();
    std::vector<double> M, rest;
    for (const int i : rows) {
      rest.push_back(values[i]);
      for (const int j : rows) M.push_back(is_kept(kind, i, j) ? entry(K, i, j) : 0.0);
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
    const Vector expected = dense_sweep(*wall.K(), kind, b, Vector(start, Teuchos::Copy));
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
  const auto lone = smoothers::make_vanka_patches(*wall.K(), smoothers::scalar_rows(*wall.K(), {}))
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
        smoothers::make_vanka(*wall.K(), smoothers::scalar_rows(*wall.K(), {}), of_kind(kind));
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
    const auto smoother = smoothers::make_vanka(K, smoothers::scalar_rows(K, {}), of_kind(kind));
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

TEUCHOS_UNIT_TEST(vanka_kinds, patches_of_nodes_need_whole_nodes) {
  const WallMatrix wall;
  auto is_pressure = smoothers::scalar_rows(*wall.K(), {});
  is_pressure[0] = 1;
  for (const std::string kind : {"diagonal", "node pair"})
    TEST_THROW(smoothers::make_vanka(*wall.K(), is_pressure, of_kind(kind)), std::invalid_argument);
}

/// The rows of the matrix itself serve where they are not those of whole nodes.
TEUCHOS_UNIT_TEST(vanka_kinds, full_patches_do_without_whole_nodes) {
  const WallMatrix wall;
  auto is_pressure = smoothers::scalar_rows(*wall.K(), {});
  const Vector x = wall.scattered(2), start = wall.scattered(3);
  Vector b(x.getMap());
  wall.K()->apply(x, b);
  // One velocity in the role of a pressure: a patch of its own, of which no other has a part.
  is_pressure[0] = 1;
  const auto smoother = smoothers::make_vanka(*wall.K(), is_pressure, of_kind("full"));
  smoother->refresh();
  Vector same(x, Teuchos::Copy), moved(start, Teuchos::Copy);
  smoother->smooth(b, same);
  TEST_COMPARE(largest_distance(same, x), <, 1e-10);
  smoother->smooth(b, moved);
  TEST_COMPARE(largest_distance(moved, start), >, 0.01);
  // Its bytes tell that it keeps no copy of the rows.
  const auto nodal =
      smoothers::make_vanka(*wall.K(), smoothers::scalar_rows(*wall.K(), {}), of_kind("full"));
  TEST_COMPARE(smoother->bytes(), <, nodal->bytes());
}

}  // namespace
