#pragma once
#include "tunica/problems/field_problem.hpp"

namespace tunica::problems {

/// How the fluid's domain follows the wall.
enum class DomainRule {
  automatic,    ///< within each Newton step, with shape derivatives where told
  newton,       ///< the same, always with them
  quasi,        ///< the same, without
  extrapolated  ///< as it lies at the start of the step
};

/// What a resolved monolithic "Coupling" list says of the system.
struct CoupledSettings {
  CoupledSettings(const Teuchos::ParameterList& list);  // NOLINT: a list is what is not decoded

  DomainRule geometry;
  double mesh_tolerance, product_tolerance;  ///< 0 where the domain is extrapolated
  SolveSettings solves;
};

}  // namespace tunica::problems
