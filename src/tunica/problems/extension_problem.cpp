#include "tunica/problems/extension_problem.hpp"

#include "tunica/algebra/picked_matrix.hpp"
#include "tunica/base/told_apart.hpp"

namespace tunica::problems {

namespace {

/// 1 at the components of nodes whose values are sought.
Vector flags_of_free(const discretisation::Extension& extension, int components = 1) {
  Vector flags(extension.mesh().owned_map(components));
  const auto flag = flags.getLocalViewHost(overwrite_all);
  for (std::size_t row = 0; row < flag.extent(0); ++row)
    flag(row, 0) = extension.is_given(static_cast<int>(row) / components) ? 0.0 : 1.0;
  return flags;
}

Teuchos::RCP<CrsMatrix> rows_of_free(const CrsMatrix& K, const Vector& flags) {
  // R K Rᵀ with numbers without gaps, as packages need them
  return algebra::renumbered(*algebra::PickedMatrix(K, flags, flags).matrix());
}

}  // namespace

ExtensionProblem::ExtensionProblem(const Teuchos::ParameterList& solver,
                                   const discretisation::HarmonicExtension& extension, int columns)
    : extension_(&extension) {
  const Vector flags = flags_of_free(extension);
  free_ = algebra::flagged_rows(flags);
  const Teuchos::RCP<CrsMatrix> K = rows_of_free(*extension.jacobian(), flags);
  solution_ = MultiVector(K->getRowMap(), columns);
  if (K->getGlobalNumRows() > 0) solver_ = linear::make_scalar_solver(solver, K);
}

ExtensionProblem::ExtensionProblem(const Teuchos::ParameterList& solver,
                                   const discretisation::ElasticExtension& extension)
    : extension_(&extension) {
  // diag(L, L, L) with the same γ preconditions K, see linear/scalar_solver.hpp.
  const Vector flags = flags_of_free(extension);
  free_ = algebra::flagged_rows(flags);
  const Teuchos::RCP<CrsMatrix> L = rows_of_free(*extension.harmonic().jacobian(), flags);
  solution_ = MultiVector(L->getRowMap(), 3);
  if (L->getGlobalNumRows() == 0) return;
  const auto K = rows_of_free(*extension.matrix(), flags_of_free(extension, 3));
  solver_ = linear::make_vector_solver(solver, K, L);
}

// L φ₀ = −F(φ_given) at the free nodes, φ = φ_given + φ₀
MultiVector ExtensionProblem::right_side(const MultiVector& given) const {
  MultiVector F(given.getMap(), given.getNumVectors());
  extension_->residual(given, F);
  MultiVector b(solution_.getMap(), given.getNumVectors());
  algebra::pick_rows(free_, F, b);
  b.scale(-1.0);
  return b;
}

Outcome ExtensionProblem::extend(MultiVector& values, const ExtensionAccuracy& accuracy) {
  if (!solver_) return Outcome::success();
  // no better than the interface itself will be known
  const linear::ScalarAnswer answer =
      solver_->solve_to({accuracy.tolerance.value_or(solver_->tolerance()), accuracy.reduction},
                        right_side(values), solution_);
  if (!answer.is_good()) {
    const auto [left, most] = told_apart(answer.residual, answer.wanted);
    solution_.putScalar(0.0);  // it may be no number, and is the next start
    return Outcome::failure("the linear solver left a relative residual of " + left +
                            " instead of " + most);
  }
  // φ = φ_given + φ₀
  algebra::add_rows(free_, 1.0, solution_, values);
  return Outcome::success();
}

// From zero: each product with the Jacobian has another right side.
void ExtensionProblem::extend_roughly(double tolerance, MultiVector& values) const {
  if (!solver_) return;
  MultiVector phi(solution_.getMap(), values.getNumVectors());
  solver_->solve_to({tolerance, 0.0, true}, right_side(values), phi);
  algebra::add_rows(free_, 1.0, phi, values);
}

void ExtensionProblem::start_from(const MultiVector& values) {
  algebra::pick_rows(free_, values, solution_);
}

// −∇·(γ σ(d)) = 0 of the three components together, or −∇·(γ ∇d_i) = 0 of each with one matrix
LawExtension::LawExtension(const MeshMotionSettings& settings, const fields::FieldMesh& mesh,
                           const std::vector<char>& is_given, discretisation::Extent extent) {
  if (settings.poisson_ratio && extent != discretisation::Extent::lines) {
    auto elastic = std::make_unique<discretisation::ElasticExtension>(
        mesh, is_given, extent, *settings.poisson_ratio, settings.stiffening);
    problem_ = std::make_unique<ExtensionProblem>(settings.linear_solver, *elastic);
    extension_ = std::move(elastic);
    return;
  }
  auto harmonic = std::make_unique<discretisation::HarmonicExtension>(mesh, is_given, extent,
                                                                      settings.stiffening);
  problem_ = std::make_unique<ExtensionProblem>(settings.linear_solver, *harmonic, 3);
  extension_ = std::move(harmonic);
}

}  // namespace tunica::problems
