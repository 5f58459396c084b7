#include <Ifpack2_BlockRelaxation.hpp>
#include <Teuchos_UnitTestHarness.hpp>
#include <numeric>

#include "tunica/smoothers/vanka/vanka.hpp"
#include "unit/algebra/distance.hpp"
#include "unit/smoothers/dense_sweep.hpp"

namespace {

using namespace tunica;
using smoothers::VankaOptions;
using test::DenseSweep;
using test::largest_distance;
using test::WallMatrix;

smoothers::VankaPatches patches_of(const CrsMatrix& K) {
  return smoothers::make_vanka_patches(K, smoothers::mixed_rows(K, {}).is_pressure);
}

/// Set up for the present values.
std::unique_ptr<smoothers::Vanka> vanka(const CrsMatrix& K, const VankaOptions& options) {
  auto smoother = smoothers::make_vanka(K, smoothers::mixed_rows(K, {}), options);
  smoother->refresh();
  return smoother;
}

VankaOptions in_order(const std::string& order, double damping = 1.0) {
  VankaOptions options;
  options.order = order;
  options.damping = damping;
  return options;
}

Vector smoothed(const WallMatrix& wall, const VankaOptions& options, const Vector& b,
                const Vector& start) {
  Vector x(start, Teuchos::Copy);
  vanka(*wall.K(), options)->smooth(b, x);
  return x;
}

/// The numbers of the patches in the order of a sweep.
std::vector<int> visits(const std::string& order, std::size_t n_patches) {
  std::vector<int> forward(n_patches);
  std::iota(forward.begin(), forward.end(), 0);
  std::vector<int> all;
  if (order != "backward") all = forward;
  if (order != "forward") all.insert(all.end(), forward.rbegin(), forward.rend());
  return all;
}

TEUCHOS_UNIT_TEST(vanka_patches, each_own_pressure_has_one_and_stands_last_in_it) {
  const WallMatrix wall;
  const auto patches = patches_of(*wall.K());
  TEST_EQUALITY(patches.n_patches(), wall.mesh().n_owned);
  const bool is_each = [&] {
    for (int p = 0; p < patches.n_patches(); ++p) {
      if (patches.rows[patches.start[p + 1] - 1] != 4 * p + 3) return false;
      for (std::size_t k = patches.start[p]; k + 1 < patches.start[p + 1]; ++k)
        if (patches.rows[k] % 4 == 3) return false;
    }
    return true;
  }();
  TEST_ASSERT(is_each);
}

TEUCHOS_UNIT_TEST(vanka_patches, hold_the_velocities_that_the_pressure_reaches_and_no_other) {
  const WallMatrix wall;
  const auto patches = patches_of(*wall.K());
  const DenseSweep expected(wall);
  TEST_EQUALITY(static_cast<std::size_t>(patches.n_patches()), expected.patches().size());
  int largest = 0;
  bool is_same = true;
  for (int p = 0; p < patches.n_patches(); ++p) {
    const std::vector<int> rows(patches.rows.data() + patches.start[p],
                                patches.rows.data() + patches.start[p + 1]);
    is_same &= rows == expected.patches()[p];
    largest = std::max(largest, patches.size(p));
  }
  TEST_ASSERT(is_same);
  TEST_EQUALITY(patches.largest(), largest);
}

TEUCHOS_UNIT_TEST(vanka_patches, eliminated_velocities_are_in_none) {
  const WallMatrix wall;
  const auto patches = patches_of(*wall.K());
  TEST_ASSERT(patches.uncovered_rows == DenseSweep(wall).uncovered_rows());
  for (int a = 0; a < wall.mesh().n_owned; ++a)
    if (wall.mesh().is_on(a, wall.tube.surface("struct_in")))
      for (int i = 0; i < 3; ++i) {
        const auto& rows = patches.rows;
        TEST_ASSERT(std::find(rows.begin(), rows.end(), 4 * a + i) == rows.end());
        const auto& lone = patches.uncovered_rows;
        TEST_ASSERT(std::find(lone.begin(), lone.end(), 4 * a + i) != lone.end());
      }
}

TEUCHOS_UNIT_TEST(vanka, a_sweep_is_a_loop_over_dense_patches) {
  const WallMatrix wall;
  const DenseSweep reference(wall);
  const Vector b = wall.scattered(1), start = wall.scattered(2);
  for (const std::string order : {"forward", "backward", "symmetric"})
    for (const double damping : {1.0, 0.6}) {
      Vector expected(start, Teuchos::Copy);
      reference.relax(b, expected, visits(order, reference.patches().size()), damping);
      TEST_COMPARE(largest_distance(smoothed(wall, in_order(order, damping), b, start), expected),
                   <, 1e-10);
    }
}

TEUCHOS_UNIT_TEST(vanka, additive_patches_see_the_same_residual_and_share_their_rows) {
  const WallMatrix wall;
  const DenseSweep reference(wall);
  const Vector b = wall.scattered(1), start = wall.scattered(2);
  for (const double damping : {1.0, 0.6}) {
    VankaOptions options = in_order("forward", damping);
    options.is_additive = true;
    Vector expected(start, Teuchos::Copy);
    reference.relax_at_once(b, expected, damping);
    TEST_COMPARE(largest_distance(smoothed(wall, options, b, start), expected), <, 1e-10);
  }
}

TEUCHOS_UNIT_TEST(vanka, sweeps_follow_one_another) {
  const WallMatrix wall;
  const Vector b = wall.scattered(1), start = wall.scattered(2);
  VankaOptions three = in_order("forward", 0.8);
  three.sweeps = 3;
  Vector x(start, Teuchos::Copy);
  for (int sweep = 0; sweep < 3; ++sweep) x = smoothed(wall, in_order("forward", 0.8), b, x);
  TEST_EQUALITY(largest_distance(smoothed(wall, three, b, start), x), 0.0);
}

TEUCHOS_UNIT_TEST(vanka, single_precision_is_close_to_double) {
  const WallMatrix wall;
  const Vector b = wall.scattered(1), start = wall.scattered(2);
  for (const bool is_additive : {false, true}) {
    VankaOptions options = in_order("symmetric");
    options.is_additive = is_additive;
    const Vector expected = smoothed(wall, options, b, start);
    const double bytes = vanka(*wall.K(), options)->bytes();
    options.is_single = true;
    const double difference = largest_distance(smoothed(wall, options, b, start), expected);
    out << "relative difference " << difference << "\n";
    TEST_COMPARE(difference, <, 1e-5);
    TEST_COMPARE(difference, >, 1e-10);
    TEST_COMPARE(vanka(*wall.K(), options)->bytes(), <, 0.75 * bytes);  // the rows stay double
  }
}

TEUCHOS_UNIT_TEST(vanka, the_exact_solution_stays) {
  const WallMatrix wall;
  const Vector x = wall.scattered(2);
  Vector b(x.getMap());
  wall.K()->apply(x, b);
  for (const std::string order : {"forward", "backward", "symmetric"})
    TEST_COMPARE(largest_distance(smoothed(wall, in_order(order), b, x), x), <, 1e-10);
  VankaOptions additive;
  additive.is_additive = true;
  TEST_COMPARE(largest_distance(smoothed(wall, additive, b, x), x), <, 1e-10);
}

/// The same matrix without the zeros that it stores.
Teuchos::RCP<CrsMatrix> without_zeros(const CrsMatrix& K) {
  const auto bare = Teuchos::rcp(new CrsMatrix(K.getRowMap(), K.getColMap(), 200));
  const auto local = K.getLocalMatrixHost();
  for (int i = 0; i < local.numRows(); ++i) {
    const auto row = local.rowConst(i);
    for (int k = 0; k < row.length; ++k)
      if (row.value(k) != 0.0) bare->insertLocalValues(i, 1, &row.value(k), &row.colidx(k));
  }
  bare->fillComplete(K.getDomainMap(), K.getRangeMap());
  return bare;
}

TEUCHOS_UNIT_TEST(vanka, rows_need_not_hold_the_unknowns_of_a_node_together) {
  const WallMatrix wall;
  const auto bare = without_zeros(*wall.K());
  TEST_COMPARE(bare->getGlobalNumEntries(), <, wall.K()->getGlobalNumEntries());
  const Vector b = wall.scattered(1), start = wall.scattered(2);
  Vector x(start, Teuchos::Copy);
  vanka(*bare, in_order("symmetric"))->smooth(b, x);
  TEST_COMPARE(largest_distance(x, smoothed(wall, in_order("symmetric"), b, start)), <, 1e-12);
}

TEUCHOS_UNIT_TEST(vanka, refresh_takes_over_new_values) {
  WallMatrix wall;
  const Vector b = wall.scattered(1), start = wall.scattered(2);
  const auto smoother = vanka(*wall.K(), in_order("forward"));
  wall.jacobian.set(0.004);
  smoother->refresh();
  Vector x(start, Teuchos::Copy);
  smoother->smooth(b, x);
  TEST_EQUALITY(largest_distance(x, smoothed(wall, in_order("forward"), b, start)), 0.0);
}

/// Ifpack2's own block relaxation visits overlapping blocks one after the other if they are given
/// as "partitioner: parts", each with the newest values: the forward sweep. It takes a block of
/// one row for a row without block, and knows no lone rows; here they are solved beforehand.
TEUCHOS_UNIT_TEST(vanka, on_one_rank_it_is_the_block_relaxation_of_ifpack2) {
  const WallMatrix wall(test::alone());
  const DenseSweep reference(wall);
  const Vector b = wall.scattered(1);
  Vector start = wall.scattered(2);
  reference.relax(b, start, {}, 1.0);  // the lone rows
  Teuchos::Array<Teuchos::ArrayRCP<int>> parts;
  for (const auto& patch : reference.patches())
    parts.push_back(Teuchos::arcpClone(Teuchos::arrayViewFromVector(patch)));
  for (const std::string order : {"forward", "symmetric"}) {
    Teuchos::ParameterList list;
    list.set("relaxation: container", "Dense").set("relaxation: damping factor", 0.7);
    list.set("relaxation: type", order == "forward" ? "Gauss-Seidel" : "Symmetric Gauss-Seidel");
    list.set("relaxation: zero starting solution", false);
    list.set("partitioner: type", "user").set("partitioner: parts", parts);
    Ifpack2::BlockRelaxation<RowMatrix> ifpack2(wall.K());
    ifpack2.setParameters(list);
    ifpack2.initialize();
    ifpack2.compute();
    Vector expected(start, Teuchos::Copy);
    ifpack2.apply(b, expected);
    TEST_COMPARE(largest_distance(expected, start), >, 0.01);
    TEST_COMPARE(largest_distance(smoothed(wall, in_order(order, 0.7), b, start), expected), <,
                 1e-10);
  }
}

/// Sets a local row to zero on the last rank only.
void clear_row(CrsMatrix& K, int row) {
  K.resumeFill();
  if (K.getComm()->getRank() + 1 == K.getComm()->getSize()) {
    auto entries = K.getLocalMatrixHost().row(row);
    for (int k = 0; k < entries.length; ++k) entries.value(k) = 0.0;
  }
  K.fillComplete(K.getDomainMap(), K.getRangeMap());
}

TEUCHOS_UNIT_TEST(vanka, a_singular_patch_of_one_rank_throws_on_all) {
  WallMatrix wall;
  const auto patches = patches_of(*wall.K());
  const auto smoother = smoothers::make_vanka(*wall.K(), smoothers::mixed_rows(*wall.K(), {}), {});
  smoother->refresh();
  clear_row(*wall.K(), patches.rows[0]);
  std::string message;
  try {
    smoother->refresh();
  } catch (const std::runtime_error& error) {
    message = error.what();
  }
  TEST_INEQUALITY(message.find("is singular"), std::string::npos);
  wall.jacobian.set(0.005);
  TEST_NOTHROW(smoother->refresh());
}

TEUCHOS_UNIT_TEST(vanka, a_lone_row_without_diagonal_throws_on_all_ranks) {
  const WallMatrix wall;
  const auto lone = patches_of(*wall.K()).uncovered_rows;
  const int most = static_cast<int>(global_max(*test::world(), lone.size()));
  TEST_COMPARE(most, >, 0);
  wall.K()->resumeFill();
  if (!lone.empty()) {
    auto entries = wall.K()->getLocalMatrixHost().row(lone[0]);
    for (int k = 0; k < entries.length; ++k) entries.value(k) = 0.0;
  }
  wall.K()->fillComplete(wall.K()->getDomainMap(), wall.K()->getRangeMap());
  TEST_THROW(vanka(*wall.K(), {}), std::runtime_error);
}

}  // namespace
