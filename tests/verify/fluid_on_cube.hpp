#pragma once
#include "cube.hpp"
#include "field_of.hpp"
#include "problems/fluid_problem.hpp"

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

}  // namespace tunica::verify
