#pragma once
#include "cube.hpp"
#include "field_of.hpp"
#include "tunica/base/error.hpp"
#include "tunica/problems/fluid_problem.hpp"

namespace tunica::verify {

/// Options of a fluid whose velocity is given all around the cube.
inline Teuchos::ParameterList enclosed_fluid(double density, double viscosity,
                                             const std::string& newton = "",
                                             const std::string& scheme = "implicit euler",
                                             const std::string& stabilisation = "inertial") {
  std::ostringstream rho, mu;
  rho << density;
  mu << viscosity;
  return resolved(
      problems::fluid_table(),
      entry("density", "double", rho.str()) + entry("viscosity", "double", mu.str()) +
          entry("time scheme", "string", scheme) + entry("stabilisation", "string", stabilisation) +
          sublist("Surfaces",
                  sublist("boundary", entry("condition", "string", "velocity") +
                                          entry("velocity", "Array(double)", "{0, 0, 0}"))) +
          sublist("Newton", newton));
}

/// The displacement of the fluid's mesh over time, nowhere at the start.
inline stepping::Timeline mesh_at_rest(const problems::FluidProblem& fluid) {
  return {fields::Places::nodes(fluid.mesh()), 3, fluid.time_scheme().remembers()};
}

/// Solves the clock's step on the mesh that moves on to d; throws Error where it cannot.
inline void solve_moving_step(problems::FluidProblem& fluid, const stepping::Clock& clock,
                              const std::vector<Vec3>& d, stepping::Timeline& mesh) {
  fluid.begin_step(clock);
  const Outcome placed =
      fluid.field().set_domain(d, fields::as_vectors(fluid.time_scheme().pasts(mesh)));
  TUNICA_CHECK(placed.is_success(), placed.reason());
  const nonlinear::NewtonReport report = fluid.solve();
  TUNICA_CHECK(report.is_converged, report.reason);
  fluid.end_step();
  fluid.time_scheme().accept(fields::as_rows(d), mesh);
}

}  // namespace tunica::verify
