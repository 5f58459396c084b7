#pragma once
#include "tunica/fields/field_mesh.hpp"
#include "tunica/fields/state.hpp"
#include "tunica/stepping/time_scheme.hpp"

namespace tunica::discretisation {

/// The parts behind the value of a history at nodes, as rows of the owned nodes under their names.
void save_parts(const stepping::History& history, const fields::FieldMesh& mesh,
                fields::State& state);
/// And back to owned and ghost nodes. Throws Error where one is missing. Collective.
void restore_parts(const fields::State& state, const fields::FieldMesh& mesh,
                   stepping::History& history);

}  // namespace tunica::discretisation
