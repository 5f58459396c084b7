#include "tunica/mesh/partition.hpp"

#include <metis.h>

#include <algorithm>
#include <array>
#include <map>

#include "tunica/base/error.hpp"
#include "tunica/mesh/faces.hpp"

namespace tunica::mesh {
namespace {

constexpr int fluid = 0, wall = 1;
constexpr int least_tets_per_part = 8;  ///< below that METIS is not asked

/// Per tetrahedron: fluid or wall.
std::vector<int> tet_fields(const Mesh& mesh, const std::vector<bool>& region_is_fluid) {
  std::vector<int> fields;
  fields.reserve(mesh.tets.size());
  for (const int region : mesh.tet_region) fields.push_back(region_is_fluid[region] ? fluid : wall);
  return fields;
}

/// Tetrahedra that share a face, in compressed rows.
struct Graph {
  std::vector<idx_t> start;
  std::vector<idx_t> neighbours;
};

Graph dual_graph(const Mesh& mesh, const std::string& name) {
  const std::vector<Face> all = faces(mesh, name);
  Graph graph;
  graph.start.assign(mesh.tets.size() + 1, 0);
  for (const Face& face : all)
    if (!face.is_boundary())
      for (const int t : face.tets) ++graph.start[t + 1];
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) graph.start[t + 1] += graph.start[t];
  graph.neighbours.resize(graph.start.back());
  std::vector<idx_t> next(graph.start.begin(), graph.start.end() - 1);
  for (const Face& face : all) {
    if (face.is_boundary()) continue;
    graph.neighbours[next[face.tets[0]]++] = face.tets[1];
    graph.neighbours[next[face.tets[1]]++] = face.tets[0];
  }
  return graph;
}

/// One balance constraint for each field that has tetrahedra.
std::vector<int> run_metis(const Mesh& mesh, int parts, const std::vector<int>& fields,
                           const std::string& name) {
  Graph graph = dual_graph(mesh, name);
  const auto fluid_tets = std::count(fields.begin(), fields.end(), fluid);
  const bool has_both = fluid_tets > 0 && fluid_tets < static_cast<long>(fields.size());
  idx_t n = static_cast<idx_t>(mesh.tets.size()), constraints = has_both ? 2 : 1, k = parts;
  std::vector<idx_t> weights(fields.size() * constraints, 1);
  if (has_both)
    for (std::size_t t = 0; t < fields.size(); ++t)
      for (const int field : {fluid, wall}) weights[2 * t + field] = fields[t] == field;
  idx_t options[METIS_NOPTIONS];
  METIS_SetDefaultOptions(options);
  options[METIS_OPTION_SEED] = 1;
  options[METIS_OPTION_NUMBERING] = 0;
  std::vector<real_t> tolerance(constraints, 1.03f);
  std::vector<idx_t> part(mesh.tets.size());
  idx_t cut = 0;
  const int status = METIS_PartGraphKway(&n, &constraints, graph.start.data(),
                                         graph.neighbours.data(), weights.data(), nullptr, nullptr,
                                         &k, nullptr, tolerance.data(), options, &cut, part.data());
  if (status != METIS_OK)
    throw std::runtime_error("METIS failed with status " + std::to_string(status));
  return {part.begin(), part.end()};
}

/// Each field in the order of its tetrahedra, in equal portions: for so few elements that
/// METIS would leave parts empty.
std::vector<int> deal(const std::vector<int>& fields, int parts) {
  std::vector<int> part(fields.size());
  for (const int field : {fluid, wall}) {
    const auto count = std::count(fields.begin(), fields.end(), field);
    long long dealt = 0;
    for (std::size_t t = 0; t < fields.size(); ++t)
      if (fields[t] == field) part[t] = static_cast<int>(dealt++ * parts / count);
  }
  return part;
}

/// Gives every part without tetrahedra of this kind the first of the part that has most.
template <typename IsOfKind>
void fill_empty_parts(std::vector<int>& part, int parts, IsOfKind is_of_kind) {
  std::vector<int> count(parts, 0);
  for (std::size_t t = 0; t < part.size(); ++t) count[part[t]] += is_of_kind(t);
  for (int p = 0; p < parts; ++p) {
    if (count[p] > 0) continue;
    const auto most = std::max_element(count.begin(), count.end());
    if (*most < 2) return;
    const int donor = static_cast<int>(most - count.begin());
    std::size_t t = 0;
    while (part[t] != donor || !is_of_kind(t)) ++t;
    part[t] = p;
    --count[donor];
    ++count[p];
  }
}

/// Tetrahedra of each vertex, in compressed rows.
struct Incidence {
  std::vector<int> start;
  std::vector<int> tets;
};

Incidence vertex_tets(const Mesh& mesh) {
  Incidence incidence;
  incidence.start.assign(mesh.vertices.size() + 1, 0);
  for (const auto& tet : mesh.tets)
    for (const int v : tet) ++incidence.start[v + 1];
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v)
    incidence.start[v + 1] += incidence.start[v];
  incidence.tets.resize(incidence.start.back());
  std::vector<int> next(incidence.start.begin(), incidence.start.end() - 1);
  for (std::size_t t = 0; t < mesh.tets.size(); ++t)
    for (const int v : mesh.tets[t]) incidence.tets[next[v]++] = static_cast<int>(t);
  return incidence;
}

/// Owners of the vertices, and the repair that leaves no part without vertices of a field.
class Owners {
public:
  Owners(const Mesh& mesh, const std::vector<int>& part, const std::vector<int>& fields, int parts)
      : part_(part), fields_(fields), incidence_(vertex_tets(mesh)), owned_(parts) {
    in_field_.resize(mesh.vertices.size());
    for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
      std::map<int, int> tets_of_part;
      for_tets(v, [&](int t) {
        ++tets_of_part[part_[t]];
        in_field_[v][fields_[t]] = true;
      });
      const auto most = std::max_element(tets_of_part.begin(), tets_of_part.end(),
                                         [](auto& a, auto& b) { return a.second < b.second; });
      owner_.push_back(most->first);
      count(v, 1);
    }
  }

  std::vector<int> repaired() {
    for (const int field : {fluid, wall})
      for (std::size_t p = 0; p < owned_.size(); ++p)
        if (owned_[p][field] == 0) take_vertex(static_cast<int>(p), field);
    return owner_;
  }

private:
  template <typename Action>
  void for_tets(std::size_t v, Action action) const {
    for (int i = incidence_.start[v]; i < incidence_.start[v + 1]; ++i) action(incidence_.tets[i]);
  }

  void count(std::size_t v, int change) {
    for (const int field : {fluid, wall})
      if (in_field_[v][field]) owned_[owner_[v]][field] += change;
  }

  bool can_give(std::size_t v) const {
    for (const int field : {fluid, wall})
      if (in_field_[v][field] && owned_[owner_[v]][field] < 2) return false;
    return true;
  }

  /// The part takes a vertex of one of its tetrahedra of the field from the richest owner.
  void take_vertex(int p, int field) {
    int best = -1;
    for (std::size_t v = 0; v < owner_.size(); ++v) {
      bool is_candidate = false;
      for_tets(v, [&](int t) { is_candidate |= part_[t] == p && fields_[t] == field; });
      if (!is_candidate || !can_give(v)) continue;
      if (best < 0 || owned_[owner_[v]][field] > owned_[owner_[best]][field])
        best = static_cast<int>(v);
    }
    if (best < 0) return;
    count(best, -1);
    owner_[best] = p;
    count(best, 1);
  }

  const std::vector<int>& part_;
  const std::vector<int>& fields_;
  Incidence incidence_;
  std::vector<std::array<int, 2>> owned_;      ///< per part: vertices of fluid and wall
  std::vector<std::array<bool, 2>> in_field_;  ///< per vertex: in fluid, in wall
  std::vector<int> owner_;
};

}  // namespace

Partition partition(const Mesh& mesh, int parts, const std::vector<bool>& region_is_fluid,
                    const std::string& name) {
  TUNICA_CHECK(parts >= 1,
               "the number of parts is " + std::to_string(parts) + ", expected 1 or more");
  TUNICA_CHECK(static_cast<std::size_t>(parts) <= mesh.tets.size(),
               name + ": more ranks than elements: " + std::to_string(parts) + " ranks, " +
                   std::to_string(mesh.tets.size()) + " tetrahedra. Use fewer ranks.");
  TUNICA_CHECK(region_is_fluid.size() == mesh.regions.size(),
               "region_is_fluid has " + std::to_string(region_is_fluid.size()) +
                   " entries, expected one per region: " + std::to_string(mesh.regions.size()));
  if (parts == 1)
    return {std::vector<int>(mesh.tets.size(), 0), std::vector<int>(mesh.vertices.size(), 0)};
  const std::vector<int> fields = tet_fields(mesh, region_is_fluid);
  const bool is_tiny = mesh.tets.size() < static_cast<std::size_t>(least_tets_per_part) * parts;
  std::vector<int> part = is_tiny ? deal(fields, parts) : run_metis(mesh, parts, fields, name);
  for (const int field : {fluid, wall})
    fill_empty_parts(part, parts, [&](std::size_t t) { return fields[t] == field; });
  fill_empty_parts(part, parts, [](std::size_t) { return true; });  // few elements: any will do
  std::vector<int> owner = Owners(mesh, part, fields, parts).repaired();
  return {std::move(part), std::move(owner)};
}

}  // namespace tunica::mesh
