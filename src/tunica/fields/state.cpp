#include "tunica/fields/state.hpp"

#include <numeric>

#include "tunica/base/error.hpp"
#include "tunica/base/map_of.hpp"
#include "tunica/fields/field_mesh.hpp"
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
  TUNICA_CHECK(rows.columns == columns && rows.values.size() == places.size() * columns,
               "\"" + name + "\" of the state has " + std::to_string(rows.columns) +
                   " numbers per node, expected " + std::to_string(columns));
  return rows;
}

std::vector<double> as_rows(const std::vector<Vec3>& vectors, int count) {
  std::vector<double> rows;
  rows.reserve(3 * count);
  for (int k = 0; k < count; ++k) rows.insert(rows.end(), vectors[k].begin(), vectors[k].end());
  return rows;
}

std::vector<double> as_rows(const std::vector<Vec3>& vectors) {
  return as_rows(vectors, static_cast<int>(vectors.size()));
}

std::vector<Vec3> as_vectors(const std::vector<double>& rows) {
  std::vector<Vec3> vectors(rows.size() / 3);
  for (std::size_t k = 0; k < vectors.size(); ++k)
    vectors[k] = {rows[3 * k], rows[3 * k + 1], rows[3 * k + 2]};
  return vectors;
}

State state_on(const FieldMesh& mesh) { return Places::owned_nodes(mesh).state(); }

State::Array rows_of(const Vector& v, int columns) {
  const auto view = v.getLocalViewHost(read_only);
  return {columns, {view.data(), view.data() + view.extent(0)}};
}

State::Array rows_of(const std::vector<Vec3>& values, int count) {
  return {3, as_rows(values, count)};
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

namespace {

bool is_split(const algebra::Block& block, const SplitMesh* split) {
  return split != nullptr && block.components == 1;
}

}  // namespace

State::Array rows_of(const algebra::BlockVector& x, int block, const SplitMesh* split) {
  const algebra::Block& of = (*x.space())[block];
  return is_split(of, split) ? rows_of(x[block], *split) : rows_of(x[block], of.components);
}

void assign_rows(const State::Array& rows, int block, const SplitMesh* split,
                 algebra::BlockVector& x) {
  if (is_split((*x.space())[block], split))
    assign_rows(rows, *split, x[block]);
  else
    assign_rows(rows, x[block]);
}

// A row has as many scalars as the vertex with the most copies.
int row_length(const algebra::Block& block, const SplitMesh* split) {
  return is_split(block, split) ? split->n_copies : block.components;
}

Places Places::of_this_rank(std::vector<GlobalOrdinal> numbers, const CommPtr& comm) {
  Places places;
  places.numbers_ = std::move(numbers);
  places.owned_.resize(places.numbers_.size());
  std::iota(places.owned_.begin(), places.owned_.end(), 0);
  places.comm_ = comm;
  return places;
}

Places Places::owned_nodes(const FieldMesh& mesh) {
  return of_this_rank({mesh.vertex.begin(), mesh.vertex.begin() + mesh.n_owned}, mesh.comm);
}

Places Places::nodes(const FieldMesh& mesh) {
  Places places = owned_nodes(mesh);  // ghosts follow the owned ones
  places.numbers_.assign(mesh.vertex.begin(), mesh.vertex.end());
  places.has_copies_ = true;
  return places;
}

Places Places::elements(const FieldMesh& mesh, int points) {
  Places places;
  places.numbers_.assign(mesh.tet_number.begin(), mesh.tet_number.end());
  for (std::size_t e = 0; e < mesh.tets.size(); ++e)
    if (mesh.is_owned[e]) places.owned_.push_back(static_cast<int>(e));
  places.has_copies_ = true;
  places.points_ = points;
  places.comm_ = mesh.comm;
  return places;
}

Places Places::everywhere() {
  Places places;
  places.numbers_ = {0};
  places.owned_ = {0};
  return places;
}

State Places::state() const {
  State state;
  if (is_everywhere()) return state;
  for (const int k : owned_) state.places.push_back(numbers_[k]);
  return state;
}

State::Array Places::owned_rows(const std::vector<double>& rows, int width) const {
  const int columns = width * points_;
  State::Array owned{columns, {}};
  owned.values.reserve(columns * owned_.size());
  for (const int k : owned_)
    owned.values.insert(owned.values.end(), rows.begin() + columns * k,
                        rows.begin() + columns * (k + 1));
  return owned;
}

std::vector<double> Places::imported(const std::vector<double>& owned, int columns) const {
  MultiVector from(map_of(state().places, comm_), columns), to(map_of(numbers_, comm_), columns);
  {
    const auto view = from.getLocalViewHost(overwrite_all);
    for (std::size_t k = 0; k < owned_.size(); ++k)
      for (int i = 0; i < columns; ++i) view(k, i) = owned[columns * k + i];
  }
  to.doImport(from, Import(from.getMap(), to.getMap()), insert);
  const auto view = to.getLocalViewHost(read_only);
  std::vector<double> rows(columns * numbers_.size());
  for (std::size_t k = 0; k < numbers_.size(); ++k)
    for (int i = 0; i < columns; ++i) rows[columns * k + i] = view(k, i);
  return rows;
}

std::vector<double> Places::local_rows(const State& state, const std::string& name,
                                       int width) const {
  const int columns = width * points_;
  const std::vector<double>& owned = state.array(name, columns).values;
  return has_copies_ ? imported(owned, columns) : owned;
}

}  // namespace tunica::fields
