#include <Teuchos_UnitTestHarness.hpp>

#include "tunica/base/error.hpp"
#include "tunica/base/trilinos.hpp"
#include "tunica/multigrid/muelu/cycle.hpp"
#include "unit/fields/small_tube.hpp"
#include "unit/multigrid/grid_blocks.hpp"

namespace {

using namespace tunica;
using test::Grid;

/// Numbers without pattern that do not depend on the ranks.
Vector rough(const Teuchos::RCP<const Map>& map, int seed) {
  Vector x(map);
  for (const GlobalOrdinal g : global_numbers(*map))
    x.replaceGlobalValue(g, test::scatter(1000.0 * seed + static_cast<double>(g)));
  return x;
}

struct System {
  Teuchos::RCP<CrsMatrix> A;
  Teuchos::RCP<multigrid::MixedCoarsening> coarsening;

  explicit System(const Grid& grid, int dofs = 1)
      : A(grid.laplacian(test::world(), dofs)),
        coarsening(Teuchos::rcp(new multigrid::MixedCoarsening(*test::blocks_on(grid).space()))) {}

  double energy(const Vector& e) const {  // eᵀ A e
    Vector Ae(e.getMap());
    A->apply(e, Ae);
    return e.dot(Ae);
  }

  /// The worst factor by which one of several cycles reduces the error in the energy norm.
  double worst_reduction(const Operator& cycle, int n_cycles = 12) const {
    Vector e = rough(A->getDomainMap(), 1), r(e.getMap()), z(e.getMap());
    double worst = 0.0;
    for (int k = 0; k < n_cycles; ++k) {
      const double before = energy(e);
      A->apply(e, r);
      cycle.apply(r, z);
      e.update(-1.0, z, 1.0);  // e ← e − M A e
      worst = std::max(worst, std::sqrt(energy(e) / before));
    }
    return worst;
  }
};

/// |A M b − b| / |b|.
double residual(const CrsMatrix& A, const Operator& M) {
  const Vector b = rough(A.getRangeMap(), 2);
  Vector x(A.getDomainMap()), r(b, Teuchos::Copy);
  M.apply(b, x);
  A.apply(x, r, Teuchos::NO_TRANS, 1.0, -1.0);
  return r.norm2() / b.norm2();
}

TEUCHOS_UNIT_TEST(cycle, more_than_halves_the_error_of_a_laplacian) {
  for (const bool has_corners : {true, false}) {
    const System system({11, 10, 12, has_corners});
    std::vector<double> reductions;
    for (const int sweeps : {1, 2}) {
      const multigrid::Cycle M(system.A, system.coarsening,
                               multigrid::nodal_cycle_list(sweeps, 20));
      reductions.push_back(system.worst_reduction(M));
      out << "sweeps " << sweeps << ": " << reductions.back() << "\n";
    }
    TEST_COMPARE(reductions[0], <, 0.5);
    TEST_COMPARE(reductions[1], <, reductions[0]);
  }
}

TEUCHOS_UNIT_TEST(cycle, treats_the_components_of_a_vector_as_it_treats_a_scalar) {
  const Grid grid{9, 8, 7, true};
  const System vector(grid, 3), scalar(grid);
  const multigrid::Cycle M3(vector.A, vector.coarsening, multigrid::nodal_cycle_list(1, 60));
  const multigrid::Cycle M(scalar.A, vector.coarsening,  // the same nodes
                           multigrid::nodal_cycle_list(1, 20));
  const Vector r = rough(scalar.A->getRangeMap(), 3);
  Vector r3(vector.A->getRangeMap()), z3(r3.getMap()), z(r.getMap());
  const auto node_values = r.getData();
  for (int a = 0; a < static_cast<int>(node_values.size()); ++a)
    for (int i = 0; i < 3; ++i) r3.replaceLocalValue(3 * a + i, (i + 1) * node_values[a]);
  M.apply(r, z);
  M3.apply(r3, z3);
  const auto one = z.getData(), three = z3.getData();
  double error = 0.0;
  for (int a = 0; a < static_cast<int>(one.size()); ++a)
    for (int i = 0; i < 3; ++i)
      error = std::max(error, std::abs(three[3 * a + i] - (i + 1) * one[a]));
  TEST_COMPARE(global_max(*test::world(), error), <, 1e-13 * z.normInf());
}

TEUCHOS_UNIT_TEST(cycle, is_symmetric) {
  const System system({8, 9, 6, true});
  const multigrid::Cycle M(system.A, system.coarsening, multigrid::nodal_cycle_list(2, 20));
  const Vector x = rough(system.A->getRangeMap(), 4), y = rough(system.A->getRangeMap(), 5);
  Vector Mx(x.getMap()), My(x.getMap());
  M.apply(x, Mx);
  M.apply(y, My);
  TEST_FLOATING_EQUALITY(Mx.dot(y), My.dot(x), 1e-12);
  TEST_COMPARE(Mx.dot(x), >, 0.0);
}

TEUCHOS_UNIT_TEST(cycle, starts_from_zero_whatever_the_result_held) {
  const System system({8, 9, 6, true});
  const multigrid::Cycle M(system.A, system.coarsening, multigrid::nodal_cycle_list(1, 20));
  const Vector b = rough(system.A->getRangeMap(), 6);
  Vector x(b.getMap()), y = rough(b.getMap(), 7);
  M.apply(b, x);
  M.apply(b, y);
  y.update(-1.0, x, 1.0);
  TEST_EQUALITY(y.normInf(), 0.0);
}

/// The list of the default cycle with a matrix for the restriction, as MueLu's own factory makes
/// it.
Teuchos::ParameterList with_restriction(Teuchos::ParameterList list) {
  Teuchos::ParameterList& factories = list.sublist("Factories");
  factories.sublist("Transpose").set("factory", "TransPFactory").set("P", "Nodes");
  // Factories are made in the order of the list: those that others name come first.
  const Teuchos::ParameterList galerkin = factories.sublist("Galerkin");
  factories.remove("Galerkin");
  factories.sublist("Galerkin") = galerkin;
  factories.sublist("Galerkin").set("R", "Transpose");
  list.sublist("Hierarchy").set("transpose: use implicit", false);
  list.sublist("Hierarchy").sublist("All").set("R", "Transpose");
  return list;
}

TEUCHOS_UNIT_TEST(cycle, a_restriction_that_is_not_stored_does_the_same) {
  const System system({9, 9, 9, false});
  const Teuchos::ParameterList list = multigrid::nodal_cycle_list(1, 5);
  const multigrid::Cycle M(system.A, system.coarsening, list);
  const multigrid::Cycle stored(system.A, system.coarsening, with_restriction(list));
  TEST_COMPARE(M.levels().unknowns.size(), >, 2);
  const Vector b = rough(system.A->getRangeMap(), 3);
  Vector x(b.getMap()), y(b.getMap());
  M.apply(b, x);
  stored.apply(b, y);
  y.update(-1.0, x, 1.0);
  TEST_COMPARE(y.normInf(), <, 1e-13 * x.normInf());
}

Vector applied(const Operator& M) {
  Vector x(M.getDomainMap());
  M.apply(rough(M.getRangeMap(), 8), x);
  return x;
}

TEUCHOS_UNIT_TEST(cycle, deep_levels_are_visited_as_muelu_does_with_a_list_that_says_so) {
  const System system({17, 17, 17, false});
  const Teuchos::ParameterList list = multigrid::nodal_cycle_list(1, 2);
  const multigrid::Cycle M(system.A, system.coarsening, list);
  TEST_COMPARE(M.levels().unknowns.size(), >=, 4);
  TEST_ASSERT(M.levels().is_w_cycle);
  Teuchos::ParameterList asked(list), shallow(list);
  asked.sublist("Hierarchy").set("cycle type", "W").set("W cycle start level", 1);
  Vector x = applied(M);
  const double size = x.normInf();
  x.update(-1.0, applied(multigrid::Cycle(system.A, system.coarsening, asked)), 1.0);
  TEST_COMPARE(x.normInf(), <, 1e-14 * size);
  shallow.sublist("Hierarchy").set("max levels", 3);
  TEST_ASSERT(!multigrid::Cycle(system.A, system.coarsening, shallow).levels().is_w_cycle);
}

TEUCHOS_UNIT_TEST(cycle, w_cycles_of_deep_levels_reduce_more_and_a_list_may_refuse_them) {
  const System system({17, 17, 17, false});
  std::vector<double> reductions;
  for (const bool has_w_cycles : {false, true}) {
    const multigrid::Cycle M(system.A, system.coarsening,
                             multigrid::nodal_cycle_list(1, 2, has_w_cycles));
    TEST_EQUALITY(M.levels().is_w_cycle, has_w_cycles);
    reductions.push_back(system.worst_reduction(M));
  }
  out << reductions[0] << " with V cycles, " << reductions[1] << " with W cycles\n";
  TEST_COMPARE(reductions[1], <, reductions[0]);
  Teuchos::ParameterList wrong = multigrid::nodal_cycle_list(1, 2);
  wrong.sublist("Hierarchy").set("W cycles on deep levels", "no");
  TEST_THROW(multigrid::check_cycle_list(wrong), Error);
}

TEUCHOS_UNIT_TEST(cycle, with_one_level_it_is_a_direct_solver) {
  const System system({7, 6, 5, false}, 3);
  Teuchos::ParameterList one_level = multigrid::nodal_cycle_list(1, 1);
  one_level.sublist("Hierarchy").set("max levels", 1);
  for (const auto& list : {one_level, multigrid::nodal_cycle_list(1, 1000000)})
    TEST_COMPARE(residual(*system.A, multigrid::Cycle(system.A, system.coarsening, list)), <,
                 1e-12);
}

TEUCHOS_UNIT_TEST(cycle, other_smoothers_of_muelu_serve_as_well) {
  const System system({11, 10, 12, true});
  Teuchos::ParameterList list = multigrid::nodal_cycle_list(1, 20);
  Teuchos::ParameterList& smoother = list.sublist("Factories").sublist("Sweeps");
  smoother.set("factory", "TrilinosSmoother").set("type", "CHEBYSHEV").remove("ParameterList");
  smoother.sublist("ParameterList")
      .set("chebyshev: degree", 3)
      .set("chebyshev: eigenvalue max iterations", 50);
  const multigrid::Cycle M(system.A, system.coarsening, list);
  TEST_COMPARE(system.worst_reduction(M), <, 0.5);
}

TEUCHOS_UNIT_TEST(cycle, a_list_that_muelu_refuses_throws) {
  const System system({4, 4, 4, true});
  Teuchos::ParameterList list = multigrid::nodal_cycle_list(1, 20);
  list.sublist("Factories").sublist("Nodes").set("factory", "NodalQFactory");
  TEST_THROW(multigrid::Cycle(system.A, system.coarsening, list), std::exception);
}

}  // namespace
