#include <Teuchos_UnitTestHarness.hpp>

#include "tunica/assembly/element_geometry.hpp"
#include "tunica/base/heap.hpp"
#include "tunica/base/trilinos.hpp"
#include "tunica/fields/block_operator.hpp"
#include "tunica/kernels/laplace_p1.hpp"
#include "tunica/linear/krylov.hpp"
#include "tunica/linear/scalar_solver.hpp"
#include "tunica/linear/solvers/conjugate_gradients.hpp"
#include "unit/fields/small_tube.hpp"

namespace {

using namespace tunica;
using test::SmallTube;

/// Laplacian plus a multiple of the identity: symmetric positive definite.
Teuchos::RCP<CrsMatrix> laplacian(const fields::FieldMesh& mesh) {
  const auto graph = fields::make_node_graph(mesh);
  const auto K = fields::make_matrix(graph, mesh, 1, 1);
  const auto geometry = assembly::ElementGeometry(mesh, mesh.x);
  K->resumeFill();
  for (std::size_t e = 0; e < mesh.tets.size(); ++e) {
    const auto Ke = kernels::laplace_p1(geometry[e]);
    for (int a = 0; a < 4; ++a)
      for (int b = 0; b < 4; ++b)
        if (mesh.tets[e][a] < mesh.n_owned)
          K->sumIntoLocalValues(mesh.tets[e][a], Teuchos::tuple<int>(mesh.tets[e][b]),
                                Teuchos::tuple<double>(Ke[a][b] + (a == b ? 0.01 : 0.0)));
  }
  K->fillComplete(mesh.node_map, mesh.node_map);
  return K;
}

std::unique_ptr<linear::ScalarSolver> solver(const std::string& method,
                                             const Teuchos::RCP<CrsMatrix>& K, int cap = 200) {
  Teuchos::ParameterList list;
  list.set("method", method);
  if (method == "cg") list.set("max iterations", cap);
  linear::scalar_solver_table().resolve(list, "Linear Solver", "");
  return linear::make_scalar_solver(list, K);
}

TEUCHOS_UNIT_TEST(scalar_solver, conjugate_gradients_and_factors_agree_in_every_column) {
  const SmallTube tube;
  const auto K = laplacian(tube.wall);
  const auto map = tube.wall.node_map;
  MultiVector exact(map, 3), B(map, 3), cg(map, 3), direct(map, 3);
  exact.randomize();
  K->apply(exact, B);
  TEST_COMPARE(solver("cg", K)->solve(B, cg), <, 1e-11);
  TEST_COMPARE(solver("direct", K)->solve(B, direct), <, 1e-11);
  std::vector<double> error(3);
  for (const MultiVector* X : {&cg, &direct}) {
    MultiVector difference(*X, Teuchos::Copy);
    difference.update(-1.0, exact, 1.0);
    difference.normInf(Teuchos::arrayViewFromVector(error));
    for (const double e : error) TEST_COMPARE(e, <, 1e-8);
  }
}

TEUCHOS_UNIT_TEST(scalar_solver, a_column_of_zeros_has_the_zero_solution) {
  const SmallTube tube;
  const auto K = laplacian(tube.wall);
  MultiVector B(tube.wall.node_map, 2), X(tube.wall.node_map, 2);
  B.getVectorNonConst(1)->randomize();
  TEST_COMPARE(solver("cg", K)->solve(B, X), <, 1e-11);
  TEST_EQUALITY(X.getVector(0)->normInf(), 0.0);
  TEST_COMPARE(X.getVector(1)->normInf(), >, 0.0);
}

TEUCHOS_UNIT_TEST(scalar_solver, an_answer_that_is_no_number_has_no_small_residual) {
  const SmallTube tube;
  const auto K = laplacian(tube.wall);
  MultiVector B(tube.wall.node_map, 2), X(tube.wall.node_map, 2);
  B.randomize();
  B.getVectorNonConst(0)->putScalar(std::nan(""));
  TEST_ASSERT(!(solver("direct", K)->solve(B, X) < 1e-8));
}

TEUCHOS_UNIT_TEST(scalar_solver, a_good_start_is_kept) {
  const SmallTube tube;
  const auto K = laplacian(tube.wall);
  MultiVector X(tube.wall.node_map, 1), B(tube.wall.node_map, 1);
  X.randomize();
  K->apply(X, B);
  MultiVector start(X, Teuchos::Copy);
  TEST_COMPARE(solver("cg", K, 1)->solve(B, X), <, 1e-12);
  X.update(-1.0, start, 1.0);
  TEST_COMPARE(X.getVector(0)->normInf(), <, 1e-9);
}

/// Five points on a grid of so many by so many.
Teuchos::RCP<CrsMatrix> laplacian_on_grid(GlobalOrdinal n) {
  const Teuchos::RCP<const Map> map = Teuchos::rcp(new Map(n * n, 0, test::world()));
  const auto K = Teuchos::rcp(new CrsMatrix(map, 5));
  for (const GlobalOrdinal row : global_numbers(*map)) {
    const auto insert = [&](bool is_inside, GlobalOrdinal column, double value) {
      if (is_inside)
        K->insertGlobalValues(row, Teuchos::tuple<GlobalOrdinal>(column), Teuchos::tuple(value));
    };
    insert(true, row, 4.0);
    insert(row % n > 0, row - 1, -1.0);
    insert(row % n < n - 1, row + 1, -1.0);
    insert(row >= n, row - n, -1.0);
    insert(row < n * (n - 1), row + n, -1.0);
  }
  K->fillComplete();
  return K;
}

TEUCHOS_UNIT_TEST(scalar_solver, factors_do_what_conjugate_gradients_do_not) {
  const auto K = laplacian_on_grid(60);  // more than the coarsest level of a cycle
  MultiVector B(K->getRowMap(), 2), X(K->getRowMap(), 2);
  B.randomize();
  Teuchos::ParameterList list;
  list.set("max iterations", 1);
  linear::scalar_solver_table().resolve(list, "Linear Solver", "");
  TEST_COMPARE(linear::make_scalar_solver(list, K)->solve(B, X), <, 1e-11);
  list.set("direct unknowns", 1);
  X.putScalar(0.0);
  TEST_COMPARE(linear::make_scalar_solver(list, K)->solve(B, X), >, 1e-6);
}

TEUCHOS_UNIT_TEST(scalar_solver, conjugate_gradients_measure_the_residual_against_their_goal) {
  const SmallTube tube;
  const auto K = laplacian(tube.wall);
  MultiVector X(tube.wall.node_map, 1), B(tube.wall.node_map, 1);
  X.randomize();
  K->apply(X, B);
  X.scale(1.0 + 1e-10);  // good enough already
  MultiVector R(B, Teuchos::Copy);
  K->apply(X, R, Teuchos::NO_TRANS, -1.0, 1.0);
  TEST_EQUALITY(linear::conjugate_gradients(*K, *K, {1e-8 * B.getVector(0)->norm2()}, 200, R, X),
                0);
}

// A run makes millions of solves.
TEUCHOS_UNIT_TEST(krylov, solves_leave_nothing_behind) {
  const SmallTube tube;
  const auto K = laplacian(tube.wall);
  MultiVector X(tube.wall.node_map, 1), B(tube.wall.node_map, 1);
  B.randomize();
  for (const std::string method : {"GCR", "GMRES"}) {
    const auto solve = [&](int times) {
      for (int i = 0; i < times; ++i) {
        X.putScalar(0.0);
        linear::solve_krylov({method, 3, 3}, K, Teuchos::null, B, X, 1e-8);
      }
      return heap_bytes();
    };
    const double before = solve(20);
    const double after = solve(500);
    out << method << ": " << before << " and " << after << " bytes\n";
    TEST_COMPARE(after - before, <, 8 * 500);  // less than a pointer per solve
  }
}

}  // namespace
