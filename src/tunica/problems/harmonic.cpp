#include "tunica/problems/harmonic.hpp"

#include <sstream>

namespace tunica::problems {

Harmonic::Harmonic(const Teuchos::ParameterList& solver,
                   const discretisation::HarmonicExtension& extension, int columns)
    : extension_(&extension), solver_(linear::make_scalar_solver(solver, extension.jacobian())),
      solution_(extension.mesh().node_map, columns) {}

// L φ₀ = −F(φ_given), φ = φ_given + φ₀
MultiVector Harmonic::right_side(const MultiVector& given) const {
  MultiVector b(given.getMap(), given.getNumVectors());
  extension_->residual(given, b);
  b.scale(-1.0);
  return b;
}

Outcome Harmonic::extend(MultiVector& values, std::optional<double> tolerance) {
  const double wanted = tolerance.value_or(solver_->tolerance());
  const double residual = solver_->solve_to(wanted, right_side(values), solution_);
  if (!(residual <= 2.0 * wanted)) {
    std::ostringstream text;
    text << "the linear solver left a relative residual of " << residual << " instead of "
         << wanted;
    solution_.putScalar(0.0);  // it may be no number, and is the next start
    return Outcome::failure(text.str());
  }
  values.update(1.0, solution_, 1.0);
  return Outcome::success();
}

void Harmonic::extend_roughly(double tolerance, MultiVector& values) const {
  MultiVector phi(values.getMap(), values.getNumVectors());
  solver_->solve_to(tolerance, right_side(values), phi);
  values.update(1.0, phi, 1.0);
}

void Harmonic::start_from(const MultiVector& values) {
  solution_.assign(values);
  const auto view = solution_.getLocalViewHost(read_write);
  for (std::size_t a = 0; a < view.extent(0); ++a)
    for (std::size_t j = 0; j < view.extent(1); ++j)
      if (extension_->is_given(static_cast<int>(a))) view(a, j) = 0.0;
}

}  // namespace tunica::problems
