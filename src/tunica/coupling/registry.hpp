#pragma once
#include <memory>

#include "tunica/coupling/scheme.hpp"
#include "tunica/problems/coupled_problem.hpp"

namespace tunica::coupling {

/// Fields that a scheme couples; all must outlive it.
struct CoupledFields {
  const fields::InterfaceTransfer& interface;
  problems::FluidProblem& fluid;
  problems::SolidProblem& wall;
  problems::MeshMotion& motion;
  const fields::FieldMesh* mesh;  ///< of both; null unless is_monolithic()
};

/// Every scheme's keys: the "Coupling" list.
params::Table coupling_table();
/// The scheme of the resolved list solves for both fields at once, on the mesh of both; a step has
/// no coupling iterations.
bool is_monolithic(const Teuchos::ParameterList& list);
std::unique_ptr<Scheme> make_scheme(const Teuchos::ParameterList& list,
                                    const CoupledFields& fields);

}  // namespace tunica::coupling
