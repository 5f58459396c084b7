#pragma once
#include "tunica/observe/force_groups.hpp"

namespace tunica::observe {

/// Adds the key "surfaces" of an "Output" list.
void add_surface_keys(params::Table& table);
/// Its value in a resolved list: names of surfaces, or the word "all" or "none" alone.
std::vector<std::string> surfaces_in(const Teuchos::ParameterList& output);
/// The surfaces that it names; none where it is one of the two words.
std::vector<std::string> named_surfaces(const std::vector<std::string>& wanted);

/// The columns of steps.csv for the surfaces of a case, in the order of the mesh, and for groups of
/// them.
class SurfaceReport {
public:
  /// wanted: see surfaces_in(). The fields must outlive the object. Collective.
  SurfaceReport(const std::vector<std::string>& wanted, std::vector<ForceGroup> groups,
                const std::vector<std::unique_ptr<Field>>& fields);

  /// At the end of a step. Collective.
  discretisation::Observables observe() const;

private:
  /// A field and the surfaces of it that are reported: indices into FieldMesh::surfaces.
  std::vector<std::pair<Field*, std::vector<int>>> fields_;
  std::vector<ForceGroup> groups_;
  Field* fluid_ = nullptr;          ///< where there are groups
  std::vector<int> more_of_fluid_;  ///< surfaces of groups that are not reported
};

}  // namespace tunica::observe
