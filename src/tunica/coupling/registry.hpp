#pragma once
#include <memory>

#include "tunica/coupling/coupling_settings.hpp"
#include "tunica/coupling/scheme.hpp"
#include "tunica/problems/coupled_problem.hpp"

namespace tunica::coupling {

/// Fields that a scheme couples; all must outlive it.
struct CoupledFields {
  const fields::InterfaceTransfer& interface;
  problems::FluidProblem& fluid;
  problems::SolidProblem& wall;
  problems::MeshMotion& motion;
  const fields::FieldMesh* mesh;  ///< of both; null unless the scheme is monolithic
};

/// Every scheme's keys: the "Coupling" list.
params::Table coupling_table();
std::unique_ptr<Scheme> make_scheme(const CouplingSettings& settings, const CoupledFields& fields);

}  // namespace tunica::coupling
