#include "tunica/discretisation/element_history.hpp"

namespace tunica::discretisation {

fields::State ElementHistory::save() const {
  fields::State state = fields::element_state_on(*mesh_);
  state.arrays["value"] = fields::element_rows_of(history_.value(), *mesh_);
  int k = 0;
  for (const std::string& name : history_.names())
    state.arrays[name] = fields::element_rows_of(history_[k++], *mesh_);
  return state;
}

std::string ElementHistory::restore(const fields::State& state) {
  history_.value() = fields::all_element_rows(state.array("value", 3), *mesh_);
  int k = 0;
  for (const std::string& name : history_.names())
    history_[k++] = fields::all_element_rows(state.array(name, 3), *mesh_);
  return "";
}

}  // namespace tunica::discretisation
