#pragma once
#include "cube.hpp"
#include "field_of.hpp"
#include "tunica/base/error.hpp"
#include "tunica/problems/fluid_problem.hpp"

namespace tunica::verify {

/// Options of a fluid whose velocity is given all around the cube.
inline Teuchos::ParameterList enclosed_fluid(double density, double viscosity,
                                             const std::string& newton = "") {
  std::ostringstream rho, mu;
  rho << density;
  mu << viscosity;
  return resolved(
      problems::fluid_table(),
      entry("density", "double", rho.str()) + entry("viscosity", "double", mu.str()) +
          sublist("Surfaces",
                  sublist("boundary", entry("condition", "string", "velocity") +
                                          entry("velocity", "Array(double)", "{0, 0, 0}"))) +
          sublist("Newton", newton));
}

/// Solves the clock's step on the mesh that moves from d_old to d; throws Error where it cannot.
inline void solve_moving_step(problems::FluidProblem& fluid, const stepping::Clock& clock,
                              const std::vector<Vec3>& d, const std::vector<Vec3>& d_old) {
  fluid.begin_step(clock);
  const Outcome placed = fluid.set_domain(d, d_old);
  TUNICA_CHECK(placed.is_success(), placed.reason());
  const nonlinear::NewtonReport report = fluid.solve();
  TUNICA_CHECK(report.is_converged, report.reason);
}

}  // namespace tunica::verify
