#include <Teuchos_UnitTestHarness.hpp>
#include <functional>

#include "tunica/multigrid/muelu/cycle.hpp"
#include "tunica/smoothers/braess_sarazin/braess_sarazin.hpp"
#include "tunica/smoothers/node_ilu/node_ilu.hpp"
#include "tunica/smoothers/vanka/vanka.hpp"
#include "unit/multigrid/complaint.hpp"
#include "unit/smoothers/wall_matrix.hpp"

namespace {

using namespace tunica;
using test::WallMatrix;
using Work = std::function<void(const MultiVector& b, MultiVector& x)>;

constexpr int n_columns = 3;

MultiVector columns(const WallMatrix& wall, int seed) {
  MultiVector all(wall.K()->getRowMap(), n_columns);
  for (int c = 0; c < n_columns; ++c) all.getVectorNonConst(c)->assign(wall.scattered(seed + c));
  return all;
}

/// How far the work on all columns is from that on each alone, in parts of the largest entry.
double worst_distance(const WallMatrix& wall, const Work& work) {
  const MultiVector b = columns(wall, 10);
  MultiVector together = columns(wall, 20), alone(together, Teuchos::Copy);
  work(b, together);
  double worst = 0.0;
  for (int c = 0; c < n_columns; ++c) {
    const auto x = alone.getVectorNonConst(c);
    work(*b.getVector(c), *x);
    Vector difference(*together.getVector(c), Teuchos::Copy);
    difference.update(-1.0, *x, 1.0);
    worst = std::max(worst, difference.normInf() / x->normInf());
  }
  return worst;
}

Teuchos::ParameterList with_smoother(const std::string& factory) {
  Teuchos::ParameterList list = multigrid::mixed_cycle_list(1);
  list.sublist("Hierarchy").set("coarse: max size", 30);
  auto& sweeps = list.sublist("Factories").sublist("Sweeps");
  sweeps = Teuchos::ParameterList();
  sweeps.set("factory", factory);
  // In single precision, round-off of the transfers shows.
  if (factory == "NodalIluSmoother") sweeps.set("precision", "double");
  return list;
}

TEUCHOS_UNIT_TEST(columns, vanka_treats_each_as_if_it_were_alone) {
  const WallMatrix wall;
  for (const bool is_additive : {false, true})
    for (const std::string patch : {"full", "diagonal", "node pair"}) {
      smoothers::VankaOptions options;
      options.is_additive = is_additive;
      options.patch = patch;
      options.sweeps = 2;
      const auto vanka =
          smoothers::make_vanka(*wall.K(), smoothers::mixed_rows(*wall.K(), {}), options);
      vanka->refresh();
      TEST_EQUALITY(worst_distance(wall, [&](const auto& b, auto& x) { vanka->smooth(b, x); }),
                    0.0);
    }
}

TEUCHOS_UNIT_TEST(columns, node_ilu_treats_each_as_if_it_were_alone) {
  const WallMatrix wall;
  const auto factors = smoothers::make_node_ilu(*wall.K(), {}, {});
  factors->refresh();
  TEST_EQUALITY(worst_distance(wall, [&](const auto& b, auto& x) { factors->smooth(0.8, b, x); }),
                0.0);
  TEST_EQUALITY(
      worst_distance(wall, [&](const auto& b, auto& x) { factors->smooth_from_zero(0.8, b, x); }),
      0.0);
}

TEUCHOS_UNIT_TEST(columns, braess_sarazin_treats_each_as_if_it_were_alone) {
  const WallMatrix wall;
  for (const std::string schur : {"gauss-seidel", "chebyshev", "direct"}) {
    smoothers::BraessSarazinOptions options;
    options.schur = schur;
    const smoothers::BraessSarazin smoother(*wall.K(), {}, options);
    TEST_EQUALITY(worst_distance(wall, [&](const auto& b, auto& x) { smoother.smooth(b, x); }),
                  0.0);
  }
}

TEUCHOS_UNIT_TEST(columns, cycles_treat_each_as_if_it_were_alone) {
  const WallMatrix wall;
  for (const std::string factory :
       {"VankaSmoother", "NodalIluSmoother", "NodalBraessSarazinSmoother", "Ifpack2Smoother"}) {
    const multigrid::Cycle cycle(wall.K(), 3, with_smoother(factory));
    out << factory << "\n";
    TEST_COMPARE(worst_distance(wall, [&](const auto& b, auto& x) { cycle.apply(b, x); }), <,
                 1e-11);
  }
}

TEUCHOS_UNIT_TEST(columns, as_many_right_hand_sides_as_solutions_are_asked_for) {
  const WallMatrix wall;
  const MultiVector b = columns(wall, 10);
  Vector x = wall.scattered(1);
  const auto factors = smoothers::make_node_ilu(*wall.K(), {}, {});
  const multigrid::Cycle cycle(wall.K(), 3, with_smoother("NodalIluSmoother"));
  factors->refresh();
  for (const std::string& text : {test::complaint([&] { factors->smooth(1.0, b, x); }),
                                  test::complaint([&] { cycle.apply(b, x); })})
    TEST_INEQUALITY(text.find("3 right-hand side(s), but 1 solution(s)"), std::string::npos);
}

}  // namespace
