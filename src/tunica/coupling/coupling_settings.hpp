#pragma once
#include <Teuchos_ParameterList.hpp>
#include <string>

namespace tunica::coupling {

/// What a resolved "Coupling" list says to others than its scheme, which decodes its own keys.
struct CouplingSettings {
  CouplingSettings(const Teuchos::ParameterList& list);  // NOLINT: a list is what is not decoded

  std::string scheme;
  /// It solves for both fields at once, on the mesh of both; a step has no coupling iterations.
  bool is_monolithic;
  int most_iterations;  ///< of a step's coupling; 0: it has none
  int most_newton;      ///< steps of Newton's method for both fields; 0: there is none
  Teuchos::ParameterList list;
};

}  // namespace tunica::coupling
