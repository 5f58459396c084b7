#pragma once
#include <map>

#include "tunica/observe/field.hpp"
#include "tunica/params/table.hpp"

namespace tunica::observe {

/// The keys of a probe where the case has a fluid, a wall, or both.
params::Table probe_table(bool has_fluid, bool has_wall);

/// "fluid" or "wall", by whose mesh a quantity of a probe lives on; empty for one that nobody
/// knows.
std::string region_of_quantity(const std::string& name);

/// Values at given points of the undeformed mesh, interpolated between the vertices.
class Probes {
public:
  Probes() = default;
  /// the_case: resolved; meshes: of fluid and wall, by these names, as far as the case has
  /// them. Throws Error on all ranks alike where a point lies outside its field. Collective.
  Probes(const Teuchos::ParameterList& the_case,
         const std::map<std::string, fields::FieldMesh>& meshes);

  /// One value per probe. Collective.
  discretisation::Observables observe(const std::vector<std::unique_ptr<Field>>& fields) const;

private:
  struct Probe {
    std::string name;
    std::string field;
    Quantity quantity;
    fields::Place place;
  };
  std::vector<Probe> probes_;
};

}  // namespace tunica::observe
