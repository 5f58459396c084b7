#pragma once
#include "tunica/observe/field.hpp"
#include "tunica/params/table.hpp"

namespace tunica::observe {

/// Adds the key "surfaces" of an "Output" list.
void add_surface_keys(params::Table& table);
/// The surfaces that a resolved "Output" list names; none where it asks for all or none.
std::vector<std::string> named_surfaces(const Teuchos::ParameterList& output);

/// The columns of steps.csv for the surfaces of a case, in the order of the mesh.
class SurfaceReport {
public:
  /// output: the resolved "Output" list. The fields must outlive the object. Collective.
  SurfaceReport(const Teuchos::ParameterList& output,
                const std::vector<std::unique_ptr<Field>>& fields);

  /// At the end of a step. Collective.
  discretisation::Observables observe() const;

private:
  /// A field and the surfaces of it that are reported: indices into FieldMesh::surfaces.
  std::vector<std::pair<Field*, std::vector<int>>> fields_;
};

}  // namespace tunica::observe
