#include "tunica/fields/state.hpp"

#include <algorithm>

#include "tunica/base/error.hpp"
#include "tunica/base/map_of.hpp"
#include "tunica/fields/split_mesh.hpp"

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

State element_state_on(const FieldMesh& mesh) {
  State state;
  for (std::size_t e = 0; e < mesh.tets.size(); ++e)
    if (mesh.is_owned[e]) state.vertices.push_back(mesh.tet_number[e]);
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

State::Array rows_of(const Vector& v, const SplitMesh& split) {
  const auto view = v.getLocalViewHost(read_only);
  int n_vertices = 0;
  for (int a = 0; a < split.n_owned; ++a) n_vertices += split.copy[a] == 0;
  State::Array rows{split.n_copies, std::vector<double>(split.n_copies * n_vertices, 0.0)};
  for (int a = 0; a < split.n_owned; ++a)
    rows.values[split.n_copies * split.node[a] + split.copy[a]] = view(a, 0);
  return rows;
}

void assign_rows(const State::Array& rows, const SplitMesh& split, Vector& v) {
  const auto view = v.getLocalViewHost(overwrite_all);
  for (int a = 0; a < split.n_owned; ++a)
    view(a, 0) = rows.values[split.n_copies * split.node[a] + split.copy[a]];
}

std::vector<Vec3> ghosted_rows(const State::Array& rows, const FieldMesh& mesh) {
  Vector owned(mesh.vector_map, false);
  assign_rows(rows, owned);
  return ghosted_vectors(mesh, owned);
}

State::Array element_rows_of(const std::vector<Vec3>& values, const FieldMesh& mesh) {
  State::Array rows{3, {}};
  rows.values.reserve(3 * std::count(mesh.is_owned.begin(), mesh.is_owned.end(), 1));
  for (std::size_t e = 0; e < mesh.tets.size(); ++e)
    if (mesh.is_owned[e]) rows.values.insert(rows.values.end(), values[e].begin(), values[e].end());
  return rows;
}

std::vector<Vec3> all_element_rows(const State::Array& rows, const FieldMesh& mesh) {
  const State owned = element_state_on(mesh);
  MultiVector from(map_of(owned.vertices, mesh.comm), 3), to(map_of(mesh.tet_number, mesh.comm), 3);
  {
    const auto view = from.getLocalViewHost(overwrite_all);
    for (std::size_t k = 0; k < owned.vertices.size(); ++k)
      for (int i = 0; i < 3; ++i) view(k, i) = rows.values[3 * k + i];
  }
  to.doImport(from, Import(from.getMap(), to.getMap()), insert);
  const auto view = to.getLocalViewHost(read_only);
  std::vector<Vec3> values(mesh.tets.size());
  for (std::size_t e = 0; e < values.size(); ++e) values[e] = {view(e, 0), view(e, 1), view(e, 2)};
  return values;
}

}  // namespace tunica::fields
