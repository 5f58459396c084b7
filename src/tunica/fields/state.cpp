#include "tunica/fields/state.hpp"

#include "tunica/base/error.hpp"
#include "tunica/fields/field_mesh.hpp"

namespace tunica::fields {

namespace {

template <class Entries>
const auto& found(const Entries& entries, const std::string& name) {
  const auto entry = entries.find(name);
  TUNICA_CHECK(entry != entries.end(), "the state lacks \"" + name + "\"");
  return entry->second;
}

}  // namespace

const std::string& State::text(const std::string& name) const { return found(texts, name); }

const std::vector<double>& State::number_list(const std::string& name) const {
  return found(numbers, name);
}

const State::Array& State::array(const std::string& name, int columns) const {
  const Array& rows = found(arrays, name);
  TUNICA_CHECK(rows.columns == columns && rows.values.size() == vertices.size() * columns,
               "\"" + name + "\" of the state has " + std::to_string(rows.columns) +
                   " numbers per node, expected " + std::to_string(columns));
  return rows;
}

State state_on(const FieldMesh& mesh) {
  State state;
  state.vertices.assign(mesh.vertex.begin(), mesh.vertex.begin() + mesh.n_owned);
  return state;
}

State::Array rows_of(const Vector& v, int columns) {
  const auto view = v.getLocalViewHost(read_only);
  return {columns, {view.data(), view.data() + view.extent(0)}};
}

State::Array rows_of(const std::vector<Vec3>& values, int count) {
  State::Array rows{3, {}};
  rows.values.reserve(3 * count);
  for (int a = 0; a < count; ++a)
    rows.values.insert(rows.values.end(), values[a].begin(), values[a].end());
  return rows;
}

void assign_rows(const State::Array& rows, Vector& v) {
  const auto view = v.getLocalViewHost(overwrite_all);
  for (std::size_t i = 0; i < rows.values.size(); ++i) view(i, 0) = rows.values[i];
}

std::vector<Vec3> ghosted_rows(const State::Array& rows, const FieldMesh& mesh) {
  Vector owned(mesh.vector_map, false);
  assign_rows(rows, owned);
  return ghosted_vectors(mesh, owned);
}

}  // namespace tunica::fields
