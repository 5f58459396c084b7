#include <Teuchos_UnitTestHarness.hpp>

#include "tunica/linear/low_rank.hpp"
#include "tunica/linear/setup_failure.hpp"
#include "unit/linear/mixed_operator.hpp"
#include "unit/linear/strategies.hpp"

namespace {

using namespace tunica;
using test::SmallTube;

/// A wall whose outer surface has two products of sizes far apart, beside its blocks.
struct Coupled {
  SmallTube tube;
  test::WallJacobian jacobian{tube};
  algebra::BlockMatrix blocks;  ///< alone

  explicit Coupled(const std::vector<double>& scales) {
    jacobian.set(0.005);
    blocks = jacobian.K;
    jacobian.K.make_low_rank(static_cast<int>(scales.size()));
    for (std::size_t k = 0; k < scales.size(); ++k) {
      auto& product = (*jacobian.K.low_rank())[static_cast<int>(k)];
      product.scale = scales[k];
      const int seed = 10 + static_cast<int>(k);
      product.w[0].assign(test::scattered(tube.wall, seed)[0]);
      product.v[0].assign(product.w[0]);
      product.v[0].update(0.1, test::scattered(tube.wall, seed + 10)[0], 1.0);  // not symmetric
    }
  }

  /// K x by hand.
  algebra::BlockVector times(const algebra::BlockVector& x) const {
    algebra::BlockVector y = blocks.zero();
    blocks.apply(x, y);
    for (int k = 0; k < jacobian.K.low_rank()->rank(); ++k) {
      const auto& product = (*jacobian.K.low_rank())[k];
      y[0].update(product.scale * product.v[0].dot(x[0]), product.w[0], 1.0);
    }
    return y;
  }
};

Teuchos::ParameterList list_of(const std::string& method, const std::string& preconditioner = "") {
  Teuchos::ParameterList list;
  list.set("method", method);
  if (!preconditioner.empty()) list.set("preconditioner", preconditioner);
  if (method != "direct") list.set("max iterations", 1000);
  linear::linear_solver_table().resolve(list, "Linear Solver", "");
  return list;
}

linear::SolveReport solve(const Teuchos::ParameterList& list, const algebra::BlockMatrix& K,
                          const algebra::BlockVector& b, algebra::BlockVector& x) {
  const auto solver = linear::make_linear_solver(list, K);
  solver->matrix_changed();
  return solver->solve(b, x, 1e-10);
}

TEUCHOS_UNIT_TEST(low_rank, products_with_the_matrix_have_it) {
  const Coupled c({3.0, 500.0});
  const auto x = test::scattered(c.tube.wall, 1);
  algebra::BlockVector y = c.blocks.zero();
  c.jacobian.K.apply(x, y);
  TEST_COMPARE(test::relative_difference(y, c.times(x)), <, 1e-14);
}

TEUCHOS_UNIT_TEST(low_rank, every_column_of_a_long_vector_gets_its_own_part) {
  const Coupled c({3.0, 500.0});
  const Teuchos::RCP<const Map> map = c.tube.wall.vector_map;
  const auto x = Teuchos::rcp(new MultiVector(map, 2)), y = Teuchos::rcp(new MultiVector(map, 2));
  x->getVectorNonConst(0)->assign(test::scattered(c.tube.wall, 1)[0]);
  x->getVectorNonConst(1)->assign(test::scattered(c.tube.wall, 2)[0]);
  y->assign(*x);
  c.jacobian.K.low_rank()->add({x}, {y}, 2.0);
  c.jacobian.K.low_rank()->add({x}, {x}, 2.0);  // in place
  for (int k = 0; k < 2; ++k) {
    Vector expected(map);
    expected.assign(test::scattered(c.tube.wall, 1 + k)[0]);
    for (int i = 0; i < 2; ++i) {
      const auto& product = (*c.jacobian.K.low_rank())[i];
      const double s = product.v[0].dot(test::scattered(c.tube.wall, 1 + k)[0]);
      expected.update(2.0 * product.scale * s, product.w[0], 1.0);
    }
    expected.update(-1.0, *y->getVector(k), 1.0);
    TEST_COMPARE(expected.norm2(), <, 1e-13 * y->getVector(k)->norm2());
  }
  x->update(-1.0, *y, 1.0);
  TEST_EQUALITY(x->getVector(0)->norm2() + x->getVector(1)->norm2(), 0.0);
}

TEUCHOS_UNIT_TEST(low_rank, every_solver_finds_the_solution_however_large_it_is) {
  for (const double scale : {1.0, 1e8}) {
    const Coupled c({3.0, scale});
    const auto exact = test::scattered(c.tube.wall, 1);
    const auto b = c.times(exact);
    std::vector<Teuchos::ParameterList> lists{list_of("direct")};
    for (const std::string method :
         {"gcr", "gmres", "flexible gmres", "bicgstab", "tfqmr", "fixed point"})
      lists.push_back(list_of(method, "direct"));
    for (const std::string method : {"gcr", "gmres", "bicgstab"})
      lists.push_back(list_of(method, "ilu"));
    for (const auto& list : lists) {
      algebra::BlockVector x = c.blocks.zero();
      const auto report = solve(list, c.jacobian.K, b, x);
      algebra::BlockVector r = c.times(x);
      test::add(-1.0, b, r);
      out << report.method << ", scale " << scale << ": " << report.iterations
          << " iterations, residual " << report.true_residual << ", error "
          << test::relative_difference(x, exact) << "\n";
      TEST_ASSERT(report.is_converged);
      TEST_COMPARE(std::abs(test::norm(r) / test::norm(b) - report.true_residual), <, 1e-11);
      TEST_COMPARE(report.true_residual, <, 2.1e-10);
    }
    algebra::BlockVector x = c.blocks.zero();
    solve(list_of("direct"), c.jacobian.K, b, x);
    TEST_COMPARE(test::relative_difference(x, exact), <, 1e-7);
  }
}

TEUCHOS_UNIT_TEST(low_rank, iterations_are_those_of_the_blocks_alone) {
  const Coupled c({3.0, 1e4});
  const auto b = test::scattered(c.tube.wall, 1);
  algebra::BlockVector x = c.blocks.zero();
  for (const std::string preconditioner : {"ilu", "direct"}) {
    const auto list = list_of("gcr", preconditioner);
    const int alone = solve(list, c.blocks, b, x).iterations;
    const int all = solve(list, c.jacobian.K, b, x).iterations;
    out << preconditioner << ": " << alone << " of the blocks, " << all << " of all\n";
    TEST_COMPARE(all, <=, 1.1 * alone + 2.0);
  }
}

TEUCHOS_UNIT_TEST(low_rank, a_sum_that_is_singular_fails_as_a_matrix_does) {
  Coupled c({1.0});
  auto& product = (*c.jacobian.K.low_rank())[0];
  algebra::BlockVector w = c.blocks.zero(), z = c.blocks.zero();
  w[0].assign(product.w[0]);
  solve(list_of("direct"), c.blocks, w, z);
  product.scale = -1.0 / product.v[0].dot(z[0]);  // K z = w + s w vᵀz = 0
  algebra::BlockVector x = c.blocks.zero();
  TEST_THROW(solve(list_of("direct"), c.jacobian.K, test::scattered(c.tube.wall, 1), x),
             linear::SetupFailure);
}

TEUCHOS_UNIT_TEST(low_rank, new_values_are_taken_over) {
  Coupled c({3.0, 5.0});
  const auto exact = test::scattered(c.tube.wall, 1);
  for (const auto& list : {list_of("direct"), list_of("gcr", "ilu")}) {
    const auto solver = linear::make_linear_solver(list, c.jacobian.K);
    for (const double scale : {5.0, -0.2, 0.0}) {
      (*c.jacobian.K.low_rank())[1].scale = scale;
      solver->matrix_changed();
      algebra::BlockVector x = c.blocks.zero();
      TEST_ASSERT(solver->solve(c.times(exact), x, 1e-10).is_converged);
      TEST_COMPARE(test::relative_difference(c.times(x), c.times(exact)), <, 1e-8);
    }
  }
}

// Z of an earlier matrix, with which a set-up begins, is part of the state that is handed on.
TEUCHOS_UNIT_TEST(low_rank, a_solver_goes_on_where_another_has_stopped) {
  Coupled c({3.0, 1e4});
  const auto b = test::scattered(c.tube.wall, 1);
  const auto list = list_of("gcr", "ilu");
  const auto first = linear::make_linear_solver(list, c.jacobian.K);
  TEST_ASSERT(first->save_vectors().empty());
  algebra::BlockVector x = c.blocks.zero(), y = c.blocks.zero(), z = c.blocks.zero();
  first->matrix_changed();
  first->solve(b, x, 1e-3);
  const auto second = linear::make_linear_solver(list, c.jacobian.K);
  second->restore(first->save());
  second->restore_vectors(first->save_vectors());
  TEST_EQUALITY(second->save_vectors().size(), 2);
  c.jacobian.set(0.006);
  const auto fresh = linear::make_linear_solver(list, c.jacobian.K);
  first->forget();
  for (linear::LinearSolver* solver : {first.get(), second.get(), fresh.get()})
    solver->matrix_changed();
  first->solve(b, x, 1e-3);
  second->solve(b, y, 1e-3);
  fresh->solve(b, z, 1e-3);
  TEST_EQUALITY(test::relative_difference(y, x), 0.0);
  TEST_INEQUALITY(test::relative_difference(z, x), 0.0);
  second->restore_vectors({x});  // of a matrix with one product
  TEST_ASSERT(second->save_vectors().empty());
}

}  // namespace
