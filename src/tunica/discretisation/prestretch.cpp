#include "tunica/discretisation/prestretch.hpp"

namespace tunica::discretisation {

namespace {

constexpr const char* names_of_rows[] = {"row x", "row y", "row z"};

}  // namespace

// Before it is found it is the identity, so that states have their arrays at all times.

fields::State Prestretch::save() const {
  fields::State state = fields::element_state_on(*mesh_);
  std::vector<Vec3> rows(mesh_->tets.size());
  for (int i = 0; i < 3; ++i) {
    for (std::size_t e = 0; e < rows.size(); ++e)
      rows[e] = values_.empty() ? identity()[i] : values_[e][i];
    state.arrays[names_of_rows[i]] = fields::element_rows_of(rows, *mesh_);
  }
  return state;
}

std::string Prestretch::restore(const fields::State& state) {
  std::vector<Mat3> values(mesh_->tets.size());
  for (int i = 0; i < 3; ++i) {
    const std::vector<Vec3> rows =
        fields::all_element_rows(state.array(names_of_rows[i], 3), *mesh_);
    for (std::size_t e = 0; e < rows.size(); ++e) values[e][i] = rows[e];
  }
  values_ = std::move(values);
  followed_();
  return "";
}

}  // namespace tunica::discretisation
