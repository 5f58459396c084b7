#pragma once
#include "tunica/problems/fluid_problem.hpp"
#include "tunica/problems/solid_problem.hpp"

namespace tunica::observe {

/// Adds the key "surfaces" of an "Output" list.
void add_surface_keys(params::Table& table);
/// The surfaces that a resolved "Output" list names; none where it asks for all or none.
std::vector<std::string> named_surfaces(const Teuchos::ParameterList& output);

/// The columns of steps.csv for the surfaces of a case, in the order of the mesh.
class SurfaceReport {
public:
  /// output: the resolved "Output" list; a field that the case lacks is null. Collective.
  SurfaceReport(const Teuchos::ParameterList& output, const fields::FieldMesh* fluid,
                const fields::FieldMesh* wall);

  /// At the end of a step. Collective.
  discretisation::Observables observe(problems::FluidProblem* fluid,
                                      problems::SolidProblem* wall) const;

private:
  std::vector<int> fluid_, wall_;  ///< indices into FieldMesh::surfaces
};

}  // namespace tunica::observe
