#include "tunica/problems/harmonic.hpp"

#include <sstream>

#include "tunica/algebra/picked_matrix.hpp"

namespace tunica::problems {

namespace {

/// 1 at nodes whose values are sought.
Vector flags_of_free(const discretisation::HarmonicExtension& extension) {
  Vector flags(extension.mesh().node_map);
  const auto flag = flags.getLocalViewHost(overwrite_all);
  for (std::size_t a = 0; a < flag.extent(0); ++a)
    flag(a, 0) = extension.is_given(static_cast<int>(a)) ? 0.0 : 1.0;
  return flags;
}

}  // namespace

Harmonic::Harmonic(const Teuchos::ParameterList& solver,
                   const discretisation::HarmonicExtension& extension, int columns)
    : extension_(&extension) {
  const Vector flags = flags_of_free(extension);
  free_ = algebra::flagged_rows(flags);
  const Teuchos::RCP<CrsMatrix> K =
      algebra::renumbered(*algebra::PickedMatrix(*extension.jacobian(), flags, flags).matrix());
  solution_ = MultiVector(K->getRowMap(), columns);
  if (K->getGlobalNumRows() > 0) solver_ = linear::make_scalar_solver(solver, K);
}

// L φ₀ = −F(φ_given) at the free nodes, φ = φ_given + φ₀
MultiVector Harmonic::right_side(const MultiVector& given) const {
  MultiVector F(given.getMap(), given.getNumVectors());
  extension_->residual(given, F);
  MultiVector b(solution_.getMap(), given.getNumVectors());
  algebra::pick_rows(free_, F, b);
  b.scale(-1.0);
  return b;
}

Outcome Harmonic::extend(MultiVector& values, std::optional<double> tolerance) {
  if (!solver_) return Outcome::success();
  const double wanted = tolerance.value_or(solver_->tolerance());
  const double residual = solver_->solve_to(wanted, right_side(values), solution_);
  if (!(residual <= 2.0 * wanted)) {
    std::ostringstream text;
    text << "the linear solver left a relative residual of " << residual << " instead of "
         << wanted;
    solution_.putScalar(0.0);  // it may be no number, and is the next start
    return Outcome::failure(text.str());
  }
  algebra::add_rows(free_, 1.0, solution_, values);
  return Outcome::success();
}

void Harmonic::extend_roughly(double tolerance, MultiVector& values) const {
  if (!solver_) return;
  MultiVector phi(solution_.getMap(), values.getNumVectors());
  solver_->solve_to(tolerance, right_side(values), phi);
  algebra::add_rows(free_, 1.0, phi, values);
}

void Harmonic::start_from(const MultiVector& values) {
  algebra::pick_rows(free_, values, solution_);
}

}  // namespace tunica::problems
