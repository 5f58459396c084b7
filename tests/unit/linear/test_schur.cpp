#include <Teuchos_UnitTestHarness.hpp>

#include "tunica/linear/krylov.hpp"
#include "tunica/multigrid/muelu/cycle.hpp"
#include "unit/linear/mixed_operator.hpp"
#include "unit/linear/strategies.hpp"

namespace {

using namespace tunica;
using test::apply;
using test::Diagonals;
using test::library_of;
using test::SmallTube;
using test::strategy;

const std::vector<std::string> lu_types{"LU Upper", "LU Lower", "LU Full"};

/// One of our strategies with the library's "Cycle" for both inverses.
Teuchos::ParameterList with_cycle(const std::string& type, const Teuchos::ParameterList& cycle) {
  Teuchos::ParameterList list = strategy(type, "Algebraic");
  library_of(list)
      .sublist("LU")
      .set("Inverse Velocity Type", "Cycle")
      .set("Inverse Schur Type", "Cycle");
  library_of(list).sublist("Cycle") = cycle;
  return list;
}

Teuchos::ParameterList muelu(const std::string& key, int value) {
  Teuchos::ParameterList list;
  list.set("Type", "MueLu").set("verbosity", "none").set(key, value);
  return list;
}

Teuchos::ParameterList nodal(int coarse_size) {
  Teuchos::ParameterList list;
  list.set("Type", "Nodal Multigrid").set("Coarse Size", coarse_size);
  return list;
}

algebra::BlockVector applied(const Teuchos::ParameterList& list, const fields::BlockOperator& K,
                             const algebra::BlockVector& r,
                             const linear::NamedOperators& operators = linear::no_operators()) {
  linear::BlockPreconditioner P(list, K, operators);
  P.refresh();
  return apply(P, K.mesh(), r);
}

// Operators of MueLu ignore the factors that they are applied with: −S̃ must not become S̃.
TEUCHOS_UNIT_TEST(schur, cycles_on_one_level_give_what_factors_give_signs_included) {
  const SmallTube tube;
  test::WallJacobian jacobian(tube);
  jacobian.set(0.005);
  const auto r = test::scattered(tube.wall, 3);
  for (const std::string& type : lu_types) {
    const auto exact = applied(strategy(type, "Algebraic"), jacobian.K, r);
    for (const auto& cycle :
         {muelu("max levels", 1), muelu("coarse: max size", 1000000), nodal(1000000)})
      TEST_COMPARE(
          test::relative_difference(applied(with_cycle(type, cycle), jacobian.K, r), exact), <,
          1e-8);
  }
}

/// C + B2 D⁻¹ B1ᵀ + m I, applied factor by factor.
class SchurSum final : public Operator {
public:
  SchurSum(const fields::BlockOperator& K, const Vector& inverse_D, double m)
      : K_(&K), inverse_D_(inverse_D, Teuchos::Copy), m_(m) {}
  Teuchos::RCP<const Map> getDomainMap() const override { return (*K_)(1, 1)->getDomainMap(); }
  Teuchos::RCP<const Map> getRangeMap() const override { return (*K_)(1, 1)->getRangeMap(); }
  void apply(const MultiVector& X, MultiVector& Y, Teuchos::ETransp, Scalar,
             Scalar) const override {
    Vector u((*K_)(0, 0)->getRowMap()), p(*X.getVector(0), Teuchos::Copy), Sp(p.getMap());
    (*K_)(0, 1)->apply(p, u);
    u.elementWiseMultiply(1.0, inverse_D_, u, 0.0);
    (*K_)(1, 0)->apply(u, Sp);
    (*K_)(1, 1)->apply(p, Sp, Teuchos::NO_TRANS, -1.0, 1.0);
    Sp.update(m_, p, 1.0);
    Y.assign(Sp);
  }

private:
  const fields::BlockOperator* K_;
  Vector inverse_D_;
  double m_;
};

/// S⁻¹ r by an unpreconditioned Krylov method.
Vector solved(const SchurSum& S, const Vector& r, double& residual) {
  Vector x(S.getDomainMap());
  const Teuchos::RCP<const Operator> op = Teuchos::rcpFromRef(S);
  residual = linear::solve_krylov({"GMRES", 2000, 2000}, op, Teuchos::null, r, x, 1e-13)
                 .recurrence_residual;
  return x;
}

/// One over D: the response of A to a translation along each axis, where it is more than a
/// thousandth of the diagonal. n_kept: how often it is.
Vector inverse_lumped_inertia(const CrsMatrix& A, double& n_kept) {
  Vector translation(A.getDomainMap()), response(A.getRangeMap()), D(A.getRangeMap());
  A.getLocalDiagCopy(D);
  double n_mine = 0.0;
  for (int axis = 0; axis < 3; ++axis) {
    translation.putScalar(0.0);
    const auto ones = translation.getLocalViewHost(read_write);
    for (std::size_t i = axis; i < ones.extent(0); i += 3) ones(i, 0) = 1.0;
    A.apply(translation, response);
    const auto sums = response.getLocalViewHost(read_only);
    const auto values = D.getLocalViewHost(read_write);
    for (std::size_t i = axis; i < values.extent(0); i += 3) {
      const double least = 1e-3 * std::abs(values(i, 0));
      n_mine += sums(i, 0) > least;
      values(i, 0) = std::max(sums(i, 0), least);
    }
  }
  n_kept = global_sum(*A.getComm(), n_mine);
  D.reciprocal(D);
  return D;
}

/// Gives every fifth row on each rank a large negative diagonal.
void spoil_inertia(CrsMatrix& A) {
  Vector diagonal(A.getRowMap());
  A.getLocalDiagCopy(diagonal);
  const auto values = diagonal.getData();
  A.resumeFill();
  for (int i = 0; i < static_cast<int>(values.size()); i += 5) {
    const GlobalOrdinal row = A.getRowMap()->getGlobalElement(i);
    A.replaceGlobalValues(row, Teuchos::tuple<GlobalOrdinal>(row),
                          Teuchos::tuple<Scalar>(-10.0 * values[i]));
  }
  A.fillComplete(A.getDomainMap(), A.getRangeMap());
}

TEUCHOS_UNIT_TEST(schur, two_scale_is_the_sum_of_two_inverses) {
  const SmallTube tube;
  test::WallJacobian jacobian(tube);
  jacobian.set(0.005);
  spoil_inertia(*jacobian.K(0, 0));
  const fields::BlockOperator& K = jacobian.K;
  const auto r = test::scattered(tube.wall, 3);
  double n_kept = 0.0;
  const Vector inverse_D = inverse_lumped_inertia(*K(0, 0), n_kept);
  TEST_COMPARE(n_kept, >, 0.0);  // both cases of D occur
  TEST_COMPARE(n_kept, <, static_cast<double>(inverse_D.getGlobalLength()));
  Vector zero(inverse_D.getMap());
  const double mass = 1e-3;
  double residual_L = 1.0, residual_M = 1.0;
  Vector expected = solved(SchurSum(K, inverse_D, 0.0), r[1], residual_L);
  expected.update(-1.0, solved(SchurSum(K, zero, mass), r[1], residual_M), -1.0);
  TEST_COMPARE(std::max(residual_L, residual_M), <, 1e-12);
  const auto z =
      applied(strategy("LU Upper", "Two Scale"), K, r, Diagonals(K, {{"Schur Mass", mass}}));
  TEST_COMPARE(test::distance(z[1], expected), <, 1e-7);
}

TEUCHOS_UNIT_TEST(schur, the_inverse_of_the_mass_has_a_type_of_its_own) {
  const SmallTube tube;
  const test::WallJacobian jacobian(tube);
  const auto r = test::scattered(tube.wall, 3);
  const Diagonals operators(jacobian.K, {{"Schur Mass", 1e-3}});
  Teuchos::ParameterList list = strategy("LU Upper", "Two Scale");
  const auto exact = applied(list, jacobian.K, r, operators);
  library_of(list).sublist("LU").set("Inverse Mass Type", "Cycle");
  library_of(list).sublist("Cycle") = nodal(1000000);
  TEST_COMPARE(test::relative_difference(applied(list, jacobian.K, r, operators), exact), <, 1e-8);
  library_of(list).sublist("Cycle") = nodal(5);  // no longer exact: it is in use
  TEST_COMPARE(test::relative_difference(applied(list, jacobian.K, r, operators), exact), >, 1e-8);
}

TEUCHOS_UNIT_TEST(nodal_multigrid, a_list_of_muelu_stands_for_the_short_keys) {
  const SmallTube tube;
  const test::WallJacobian jacobian(tube);
  const auto r = test::scattered(tube.wall, 3);
  Teuchos::ParameterList short_keys = nodal(5), whole_list;
  short_keys.set("Sweeps", 3);
  whole_list.set("Type", "Nodal Multigrid");
  whole_list.sublist("MueLu") = multigrid::nodal_cycle_list(3, 5);
  const auto z = applied(with_cycle("LU Upper", short_keys), jacobian.K, r);
  TEST_EQUALITY(
      test::relative_difference(applied(with_cycle("LU Upper", whole_list), jacobian.K, r), z),
      0.0);
  short_keys.set("Sweeps", 1);
  TEST_COMPARE(
      test::relative_difference(applied(with_cycle("LU Upper", short_keys), jacobian.K, r), z), >,
      1e-8);
}

/// What the check of a case says to a list with this entry of "Nodal Multigrid".
template <class Value>
std::string message_of(const std::string& key, const Value& value) {
  Teuchos::ParameterList cycle = nodal(500);
  cycle.set(key, value);
  try {
    test::solver_list("gcr", with_cycle("LU Upper", cycle));
  } catch (const std::exception& error) {
    return error.what();
  }
  return "";
}

TEUCHOS_UNIT_TEST(nodal_multigrid, slips_in_its_list_are_refused_before_anything_is_solved) {
  const auto says = [&out](const std::string& message, const std::string& part) {
    out << message << "\n";
    return message.find("Linear Solver") == 0 && message.find(part) != std::string::npos;
  };
  TEST_EQUALITY(message_of("Sweeps", 2), "");
  TEST_ASSERT(says(message_of("Sweps", 2), "unknown key \"Sweps\". Did you mean \"Sweeps\"?"));
  TEST_ASSERT(says(message_of("Sweeps", "two"), "\"Sweeps\""));
  TEST_ASSERT(says(message_of("Sweeps", 2.0), "\"Sweeps\""));
  TEST_ASSERT(says(message_of("Sweeps", 0), "at least 1"));
  TEST_ASSERT(says(message_of("Coarse Size", 0), "at least 1"));
}

}  // namespace
