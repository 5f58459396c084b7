#include "tunica/discretisation/nodal_history.hpp"

namespace tunica::discretisation {

void save_parts(const stepping::History& history, const fields::FieldMesh& mesh,
                fields::State& state) {
  int k = 0;
  for (const std::string& name : history.names())
    state.arrays[name] = fields::rows_of(history[k++], mesh.n_owned);
}

void restore_parts(const fields::State& state, const fields::FieldMesh& mesh,
                   stepping::History& history) {
  int k = 0;
  for (const std::string& name : history.names())
    history[k++] = fields::ghosted_rows(state.array(name, 3), mesh);
}

}  // namespace tunica::discretisation
