#pragma once
#include "tunica/fields/locate.hpp"
#include "tunica/problems/fluid_problem.hpp"
#include "tunica/problems/solid_problem.hpp"

namespace tunica::observe {

/// The keys of a probe where the case has a fluid, a wall, or both.
params::Table probe_table(bool has_fluid, bool has_wall);

/// Values at given points of the undeformed mesh, interpolated between the vertices.
class Probes {
public:
  Probes() = default;
  /// list: the resolved "Probes" list; a field that the case lacks is null. Throws Error on all
  /// ranks alike where a point lies outside its field. Collective.
  Probes(const Teuchos::ParameterList& list, const fields::FieldMesh* fluid,
         const fields::FieldMesh* wall);

  /// One value per probe. Collective.
  discretisation::Observables observe(const problems::FluidProblem* fluid,
                                      const problems::SolidProblem* wall) const;

private:
  struct Probe {
    std::string name;
    std::string quantity;
    fields::Place place;
  };
  std::vector<Probe> probes_;
};

}  // namespace tunica::observe
