#pragma once
#include "tunica/observe/field.hpp"
#include "tunica/params/table.hpp"

namespace tunica::observe {

/// Surfaces whose forces are summed: pressure and friction of the fluid along two directions.
struct ForceGroup {
  std::string name;
  std::vector<std::string> surfaces;
  Vec3 drag, lift;    ///< directions, of length 1
  double per_length;  ///< that the forces are divided by [mm]; 0: they are not
};

/// Adds the list "Force Groups" of an "Output" list.
void add_force_group_keys(params::Table& table);
/// Of a resolved case; none where its "Output" has no such list.
std::vector<ForceGroup> force_groups_in(const Teuchos::ParameterList& the_case);
/// The surfaces of all of them, each once.
std::vector<std::string> surfaces_of(const std::vector<ForceGroup>& groups);

/// drag and lift of the groups, from columns of their surfaces.
discretisation::Observables summed_forces(const std::vector<ForceGroup>& groups,
                                          const discretisation::Observables& of_surfaces);

}  // namespace tunica::observe
