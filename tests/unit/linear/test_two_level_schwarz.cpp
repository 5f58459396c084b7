#include <Teuchos_UnitTestHarness.hpp>

#include "unit/linear/mixed_operator.hpp"

namespace {

using namespace tunica;

std::unique_ptr<linear::LinearSolver> schwarz_solver(const std::string& coarse_space,
                                                     const algebra::BlockMatrix& K) {
  Teuchos::ParameterList list;
  list.set("method", "gmres");
  list.set("preconditioner", "two-level schwarz");
  list.set("coarse space", coarse_space);
  list.set("refresh factor", 0.0);  // a set-up for each matrix
  linear::linear_solver_table().resolve(list, "Linear Solver", "");
  auto solver = linear::make_linear_solver(list, K);
  solver->matrix_changed();
  return solver;
}

TEUCHOS_UNIT_TEST(two_level_schwarz, follows_the_matrix) {
  const test::SmallTube tube;
  test::WallJacobian jacobian(tube);
  const auto b = test::scattered(tube.wall, 1);
  // of a lone rank the subdomain is all there is
  const int most = jacobian.K.comm()->getSize() == 1 ? 4 : 60;
  for (const std::string coarse_space : {"GDSW", "RGDSW"}) {
    const auto solver = schwarz_solver(coarse_space, jacobian.K);
    for (const double size : {0.0, 0.005}) {
      jacobian.set(size);
      solver->matrix_changed();
      algebra::BlockVector x = jacobian.K.zero(), y = x, Kx = x;
      const auto kept = solver->solve(b, x, 1e-8);
      const auto anew = schwarz_solver(coarse_space, jacobian.K)->solve(b, y, 1e-8);
      out << coarse_space << ": " << kept.iterations << " and " << anew.iterations << "\n";
      jacobian.K.apply(x, Kx);
      TEST_ASSERT(kept.is_converged);
      TEST_COMPARE(test::relative_difference(Kx, b), <, 2.1e-8);
      TEST_EQUALITY(kept.iterations, anew.iterations);
      TEST_COMPARE(kept.iterations, <=, most);
    }
  }
}

}  // namespace
