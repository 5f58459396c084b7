#include <Teuchos_UnitTestHarness.hpp>

#include "tunica/base/error.hpp"
#include "tunica/linear/krylov.hpp"
#include "unit/linear/mixed_operator.hpp"
#include "unit/linear/strategies.hpp"

namespace {

using namespace tunica;
using test::apply;
using test::Diagonals;
using test::distance;
using test::library_of;
using test::SmallTube;
using test::solver_list;
using test::strategy;

/// Takes everything but the diagonal out of A, so that diag(A)⁻¹ is its inverse.
void make_diagonal(CrsMatrix& A) {
  const auto map = A.getColMap();
  A.resumeFill();
  {
    const auto local = A.getLocalMatrixHost();
    for (int i = 0; i < local.numRows(); ++i) {
      auto row = local.row(i);
      for (int k = 0; k < row.length; ++k)
        if (map->getGlobalElement(row.colidx(k)) != A.getRowMap()->getGlobalElement(i))
          row.value(k) = 0.0;
    }
  }
  A.fillComplete(A.getDomainMap(), A.getRangeMap());
}

/// (C + B2 diag(A)⁻¹ B1ᵀ) p.
Vector schur_times(const fields::BlockOperator& K, const Vector& p) {
  Vector diagonal(K(0, 0)->getRowMap()), u(K(0, 0)->getRowMap()), Sp(K(1, 1)->getRowMap());
  K(0, 0)->getLocalDiagCopy(diagonal);
  diagonal.reciprocal(diagonal);
  K(0, 1)->apply(p, u);
  u.elementWiseMultiply(1.0, diagonal, u, 0.0);
  K(1, 0)->apply(u, Sp);
  K(1, 1)->apply(p, Sp, Teuchos::NO_TRANS, -1.0, 1.0);
  return Sp;
}

TEUCHOS_UNIT_TEST(block_lu, with_exact_blocks_it_solves_in_at_most_two_iterations) {
  const SmallTube tube;
  test::WallJacobian jacobian(tube);
  make_diagonal(*jacobian.K(0, 0));
  const auto b = test::scattered(tube.wall, 1);
  for (const std::string type : {"LU Upper", "LU Lower", "LU Full"}) {
    const auto solver =
        linear::make_linear_solver(solver_list("gcr", strategy(type, "Algebraic")), jacobian.K);
    solver->matrix_changed();
    algebra::BlockVector x = fields::zero_vector(tube.wall);
    const auto report = solver->solve(b, x, 1e-8);
    TEST_ASSERT(report.is_converged);
    TEST_COMPARE(report.iterations, <=, type == "LU Full" ? 1 : 2);
  }
}

TEUCHOS_UNIT_TEST(block_lu, upper_and_lower_are_the_inverses_of_their_block_formulas) {
  const SmallTube tube;
  test::WallJacobian jacobian(tube);
  jacobian.set(0.005);
  const fields::BlockOperator& K = jacobian.K;
  const auto r = test::scattered(tube.wall, 3);
  for (const std::string type : {"LU Upper", "LU Lower", "LU Full"}) {
    linear::BlockPreconditioner P(strategy(type, "Algebraic"), K, linear::no_operators());
    P.refresh();
    const auto z = apply(P, tube.wall, r);
    Vector u(r[0], Teuchos::Copy), p(r[1], Teuchos::Copy);
    K(0, 0)->apply(z[0], u);  // P z must give r back
    Vector minus_Sz = schur_times(K, z[1]);
    minus_Sz.scale(-1.0);
    p.assign(minus_Sz);
    if (type != "LU Lower") K(0, 1)->apply(z[1], u, Teuchos::NO_TRANS, 1.0, 1.0);
    if (type == "LU Lower") K(1, 0)->apply(z[0], p, Teuchos::NO_TRANS, 1.0, 1.0);
    if (type == "LU Full") {  // second row: B2 A⁻¹ r_u − S z_p, and A⁻¹ r_u = z_u + A⁻¹ B1ᵀ z_p
      linear::BlockPreconditioner L(strategy("LU Lower", "Algebraic"), K, linear::no_operators());
      L.refresh();
      const auto A_inverse_r = apply(L, tube.wall, r);
      K(1, 0)->apply(A_inverse_r[0], p, Teuchos::NO_TRANS, 1.0, 1.0);
    }
    TEST_COMPARE(distance(u, r[0]), <, 1e-9);
    TEST_COMPARE(distance(p, r[1]), <, 1e-9);
  }
}

TEUCHOS_UNIT_TEST(block_lu, the_papers_schur_complements_follow_their_formulas) {
  const SmallTube tube;
  test::WallJacobian jacobian(tube);
  const auto r = test::scattered(tube.wall, 3);
  const Diagonals operators(jacobian.K, {{"Schur Laplacian", 2.0},
                                         {"Schur Mass", 4.0},
                                         {"Schur Convection", 3.0},
                                         {"Schur Bulk Mass", 0.5}});
  const auto factor_of = [&](const std::string& schur, const std::string& key, bool value,
                             double theta) {
    Teuchos::ParameterList list = strategy("LU Upper", schur);
    Teuchos::ParameterList& own = library_of(list).sublist("LU");
    if (schur == "Operator Splitting")
      own.set("Stabilisation", false).set(key, value);
    else
      own.set("Theta Factor", theta);
    linear::BlockPreconditioner P(list, jacobian.K, operators);
    P.refresh();
    const auto z = apply(P, tube.wall, r);
    return -z[1].dot(r[1]) / r[1].dot(r[1]);
  };
  // L⁻¹ + M⁻¹, L⁻¹ + M⁻¹ + M⁻¹ N L⁻¹, and the inverse of M_s/θ + M_b
  TEST_FLOATING_EQUALITY(factor_of("Operator Splitting", "Convection", false, 0), 0.75, 1e-12);
  TEST_FLOATING_EQUALITY(factor_of("Operator Splitting", "Convection", true, 0), 1.125, 1e-12);
  TEST_FLOATING_EQUALITY(factor_of("Scaled Mass", "", false, 1.0), 1.0 / 4.5, 1e-12);
  TEST_FLOATING_EQUALITY(factor_of("Scaled Mass", "", false, 2.0), 1.0 / 2.5, 1e-12);
}

TEUCHOS_UNIT_TEST(block_lu, the_stabilisation_joins_the_laplacian) {
  const SmallTube tube;
  test::WallJacobian jacobian(tube);
  const auto r = test::scattered(tube.wall, 3);
  const Diagonals operators(jacobian.K, {{"Schur Laplacian", 2.0}, {"Schur Mass", 1e30}});
  linear::BlockPreconditioner P(strategy("LU Upper", "Operator Splitting"), jacobian.K, operators);
  P.refresh();
  const auto z = apply(P, tube.wall, r);
  Vector back(z[1], Teuchos::Copy);  // −(L + C) z = r
  jacobian.K(1, 1)->apply(z[1], back, Teuchos::NO_TRANS, 1.0, -2.0);
  TEST_COMPARE(distance(back, r[1]), <, 1e-9);
}

TEUCHOS_UNIT_TEST(block_lu, unknown_names_are_refused_with_the_known_ones) {
  const SmallTube tube;
  test::WallJacobian jacobian(tube);
  const auto message_of = [&](const Teuchos::ParameterList& list) -> std::string {
    try {
      linear::BlockPreconditioner P(list, jacobian.K, linear::no_operators());
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  };
  for (const std::string& message :
       {message_of(strategy("LU Uper", "Algebraic")), message_of(strategy("LU Upper", "Algebra"))})
    TEST_ASSERT(message.find("\"LU Upper\"") != std::string::npos);
  Teuchos::ParameterList wrong = strategy("LU Upper", "Algebraic");
  wrong.set("Preconditioner Type", "MueLu");
  TEST_ASSERT(message_of(wrong).find("expected \"Teko\"") != std::string::npos);
}

TEUCHOS_UNIT_TEST(block_lu, a_case_with_a_slip_in_its_list_is_refused) {
  const auto message_of = [](const std::string& key) -> std::string {
    Teuchos::ParameterList list = strategy("LU Upper", "Algebraic");
    library_of(list).sublist("LU").set(key, "Amesos2");
    try {
      solver_list("gcr", list);
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  };
  TEST_EQUALITY(message_of("Inverse Velocity Type"), "");
  TEST_ASSERT(message_of("Inverse Velocity Tipe").find("Linear Solver") == 0);
}

TEUCHOS_UNIT_TEST(block_lu, an_operator_that_nobody_offers_is_missed_at_once) {
  const SmallTube tube;
  test::WallJacobian jacobian(tube);
  TEST_THROW(linear::BlockPreconditioner(strategy("LU Upper", "Scaled Mass"), jacobian.K,
                                         linear::no_operators()),
             Error);
}

TEUCHOS_UNIT_TEST(block_lu, the_default_solves_a_real_jacobian_by_every_method) {
  const SmallTube tube;
  test::WallJacobian jacobian(tube);
  jacobian.set(0.005);
  const Diagonals operators(jacobian.K, {{"Schur Mass", 1e-6}});
  const auto b = test::scattered(tube.wall, 2);
  for (const std::string method : {"gcr", "flexible gmres", "gmres", "bicgstab", "tfqmr"}) {
    const auto solver = linear::make_linear_solver(
        solver_list(method, linear::default_block_preconditioner(4, 2)), jacobian.K, operators);
    solver->matrix_changed();
    algebra::BlockVector x = fields::zero_vector(tube.wall);
    const auto report = solver->solve(b, x, 1e-8);
    out << method << ": " << report.iterations << "\n";
    TEST_ASSERT(report.is_converged);
    TEST_COMPARE(report.iterations, <, 60);
  }
}

TEUCHOS_UNIT_TEST(gcr, takes_the_iterations_of_flexible_gmres) {
  const SmallTube tube;
  test::WallJacobian jacobian(tube);
  const auto b = test::scattered(tube.wall, 1);
  std::vector<int> iterations;
  for (const std::string method : {"gcr", "flexible gmres"}) {
    const auto solver = linear::make_linear_solver(
        solver_list(method, strategy("LU Upper", "Algebraic")), jacobian.K);
    solver->matrix_changed();
    algebra::BlockVector x = fields::zero_vector(tube.wall);
    const auto report = solver->solve(b, x, 1e-8);
    TEST_ASSERT(report.is_converged);
    iterations.push_back(report.iterations);
  }
  TEST_EQUALITY(iterations[0], iterations[1]);
}

TEUCHOS_UNIT_TEST(gcr, restarts_and_keeps_to_its_cap) {
  const SmallTube tube;
  test::WallJacobian jacobian(tube);
  const auto b = test::scattered(tube.wall, 1);
  const Diagonals operators(jacobian.K, {{"Schur Mass", 1e-6}});
  Teuchos::ParameterList list = solver_list("gcr", linear::default_block_preconditioner(4, 2));
  list.set("restart", 5).set("max iterations", 1000);
  algebra::BlockVector x = fields::zero_vector(tube.wall);
  const auto restarted = linear::make_linear_solver(list, jacobian.K, operators);
  restarted->matrix_changed();
  TEST_ASSERT(restarted->solve(b, x, 1e-8).is_converged);
  list.set("max iterations", 3);
  const auto capped = linear::make_linear_solver(list, jacobian.K, operators);
  capped->matrix_changed();
  const auto report = capped->solve(b, x, 1e-8);
  TEST_ASSERT(!report.is_converged);
  TEST_EQUALITY(report.iterations, 3);
  TEST_FLOATING_EQUALITY(report.recurrence_residual, report.true_residual, 1e-6);
}

/// size D S + I with the skew S of pairs of rows and a diagonal D: for a large size what it makes
/// of r is normal to r, for zero it is r.
class Turning final : public Operator {
public:
  Turning(const Teuchos::RCP<const Map>& map, double size) : map_(map), size_(size) {}
  Teuchos::RCP<const Map> getDomainMap() const override { return map_; }
  Teuchos::RCP<const Map> getRangeMap() const override { return map_; }
  void apply(const MultiVector& X, MultiVector& Y, Teuchos::ETransp, double,
             double) const override {
    const auto x = X.getLocalViewHost(read_only);
    const auto y = Y.getLocalViewHost(overwrite_all);
    for (std::size_t i = 0; i < x.extent(0); i += 2) {
      const double s = size_ * (1.0 + 0.1 * static_cast<double>(i % 5));
      y(i, 0) = s * x(i + 1, 0) + x(i, 0);
      y(i + 1, 0) = -s * x(i, 0) + x(i + 1, 0);
    }
  }

private:
  Teuchos::RCP<const Map> map_;
  double size_;
};

// r stands still in every other iteration, and S² = −s² leads on.
TEUCHOS_UNIT_TEST(gcr, goes_on_as_flexible_gmres_where_the_residual_stands_still) {
  const auto world = Tpetra::getDefaultComm();
  const Teuchos::RCP<const Map> map = Teuchos::rcp(new Map(100 * world->getSize(), 0, world));
  const Turning P(map, 1e8);
  MultiVector b(map, 1), x(map, 1);
  b.randomize();
  const auto A = Teuchos::rcp(new Turning(map, 0.0));
  const auto result = linear::solve_krylov({"GCR", 40, 40}, A, Teuchos::rcpFromRef(P), b, x, 1e-8);
  out << result.iterations << " iterations\n";
  TEST_COMPARE(result.recurrence_residual, <, 1e-8);
  TEST_COMPARE(result.iterations, <, 20);
  x.update(-1.0, b, 1.0);
  TEST_COMPARE(x.getVector(0)->norm2(), <, 1e-7 * b.getVector(0)->norm2());
}

}  // namespace
