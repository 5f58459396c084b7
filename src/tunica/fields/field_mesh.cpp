#include "tunica/fields/field_mesh.hpp"

#include <algorithm>
#include <map>

#include "tunica/base/reduce.hpp"
#include "tunica/mesh/faces.hpp"
#include "tunica/mesh/partition.hpp"

namespace tunica::fields {

namespace {

using Triple = std::array<int, 3>;

Triple sorted(Triple t) {
  std::sort(t.begin(), t.end());
  return t;
}

/// Numbers of the field's nodes for the whole mesh: contiguous on each rank.
struct Numbering {
  std::vector<long long> global;    ///< per mesh vertex; -1 outside the field
  std::vector<long long> first;     ///< per rank, and the total at the end
  std::vector<int> owned_vertices;  ///< of the calling rank, in the order of their numbers
};

Numbering number_nodes(const mesh::Mesh& mesh, const mesh::Partition& partition,
                       const std::vector<char>& is_in_field, int rank, int ranks) {
  std::vector<char> is_used(mesh.vertices.size(), 0);
  for (std::size_t e = 0; e < mesh.tets.size(); ++e)
    if (is_in_field[mesh.tet_region[e]])
      for (const int v : mesh.tets[e]) is_used[v] = 1;
  Numbering n;
  n.first.assign(ranks + 1, 0);
  for (std::size_t v = 0; v < is_used.size(); ++v)
    if (is_used[v]) ++n.first[partition.vertex_owner[v] + 1];
  for (int r = 0; r < ranks; ++r) n.first[r + 1] += n.first[r];
  n.global.assign(is_used.size(), -1);
  std::vector<long long> next(n.first.begin(), n.first.end() - 1);
  for (std::size_t v = 0; v < is_used.size(); ++v) {
    if (!is_used[v]) continue;
    n.global[v] = next[partition.vertex_owner[v]]++;
    if (partition.vertex_owner[v] == rank) n.owned_vertices.push_back(static_cast<int>(v));
  }
  return n;
}

/// Adds the rank's nodes: owned ones in order, ghosts by their global number.
std::vector<int> add_nodes(const mesh::Mesh& mesh, const Numbering& n, const std::vector<int>& tets,
                           FieldMesh& field) {
  std::vector<int> local(mesh.vertices.size(), -1);
  field.vertex = n.owned_vertices;
  field.n_owned = static_cast<int>(field.vertex.size());
  for (int i = 0; i < field.n_owned; ++i) local[field.vertex[i]] = i;
  std::vector<int> ghosts;
  for (const int e : tets)
    for (const int v : mesh.tets[e])
      if (local[v] < 0) {
        local[v] = 0;
        ghosts.push_back(v);
      }
  std::sort(ghosts.begin(), ghosts.end(), [&n](int a, int b) { return n.global[a] < n.global[b]; });
  for (const int v : ghosts) {
    local[v] = static_cast<int>(field.vertex.size());
    field.vertex.push_back(v);
  }
  for (const int v : field.vertex) field.x.push_back(mesh.vertices[v]);
  return local;
}

/// Boundary triangles and the surfaces each node of the mesh lies on. A triangle between two
/// tetrahedra of the field, as on a layer boundary, is not part of the field's boundary.
void add_faces(const mesh::Mesh& mesh, const mesh::Partition& partition,
               const std::vector<char>& is_in_field, const std::vector<int>& local,
               FieldMesh& field) {
  struct Owner {
    int surface;
    int tets = 0;
    int tet = -1;
    Triple outward{};
  };
  std::map<Triple, Owner> owners;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    owners[sorted(mesh.triangles[t])].surface = mesh.triangle_surface[t];
  for (std::size_t e = 0; e < mesh.tets.size(); ++e) {
    if (!is_in_field[mesh.tet_region[e]]) continue;
    for (const auto& f : mesh::tet_faces) {
      const Triple face{mesh.tets[e][f[0]], mesh.tets[e][f[1]], mesh.tets[e][f[2]]};
      const auto found = owners.find(sorted(face));
      if (found == owners.end()) continue;
      ++found->second.tets;
      found->second.tet = static_cast<int>(e);
      found->second.outward = face;
    }
  }
  std::vector<std::pair<int, int>> on_surfaces;
  const int rank = field.comm->getRank();
  for (const auto& [key, owner] : owners) {
    if (owner.tets != 1) continue;
    Face face{{}, owner.surface, partition.tet_part[owner.tet] == rank, -1};
    bool touches_owned = face.is_owned;
    bool is_local = true;
    for (int k = 0; k < 3; ++k) {
      face.nodes[k] = local[owner.outward[k]];
      is_local = is_local && face.nodes[k] >= 0;
      if (face.nodes[k] >= 0) {
        on_surfaces.emplace_back(face.nodes[k], owner.surface);
        touches_owned = touches_owned || face.nodes[k] < field.n_owned;
      }
    }
    if (!is_local || !touches_owned) continue;
    const auto& numbers = field.tet_number;  // they ascend
    const auto tet = std::lower_bound(numbers.begin(), numbers.end(), owner.tet + 1);
    face.tet = static_cast<int>(tet - numbers.begin());
    field.faces.push_back(face);
  }
  field.node_surfaces = NodeSurfaces(field.n_nodes(), std::move(on_surfaces));
}

/// Numbers that ascend without gaps from rank to rank become a contiguous map, which needs no
/// directory.
Teuchos::RCP<const Map> map_of_dofs(const std::vector<GlobalOrdinal>& nodes, int dofs,
                                    bool is_contiguous, const CommPtr& comm) {
  const auto unknown = Teuchos::OrdinalTraits<Tpetra::global_size_t>::invalid();
  if (is_contiguous) return Teuchos::rcp(new Map(unknown, dofs * nodes.size(), 0, comm));
  std::vector<GlobalOrdinal> numbers;
  numbers.reserve(nodes.size() * dofs);
  for (const GlobalOrdinal g : nodes)
    for (int i = 0; i < dofs; ++i) numbers.push_back(dofs * g + i);
  return Teuchos::rcp(new Map(unknown, Teuchos::arrayViewFromVector(numbers), 0, comm));
}

bool is_contiguous(const std::vector<GlobalOrdinal>& numbers, const Comm& comm) {
  long long mine = static_cast<long long>(numbers.size()), up_to_here = 0;
  Teuchos::scan(comm, Teuchos::REDUCE_SUM, 1, &mine, &up_to_here);
  bool is_mine = true;
  for (std::size_t i = 0; i < numbers.size(); ++i)
    is_mine &= numbers[i] == up_to_here - mine + static_cast<GlobalOrdinal>(i);
  return all_agree(comm, is_mine);
}

}  // namespace

NodeSurfaces::NodeSurfaces(int n_nodes, std::vector<std::pair<int, int>> pairs)
    : first_(n_nodes + 1, 0) {
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  surface_.reserve(pairs.size());
  for (const auto& [node, surface] : pairs) {
    ++first_[node + 1];
    surface_.push_back(surface);
  }
  for (int a = 0; a < n_nodes; ++a) first_[a + 1] += first_[a];
}

void set_maps(const std::vector<GlobalOrdinal>& numbers, FieldMesh& mesh) {
  const std::vector<GlobalOrdinal> owned(numbers.begin(), numbers.begin() + mesh.n_owned);
  const bool is_plain = is_contiguous(owned, *mesh.comm);
  mesh.node_map = map_of_dofs(owned, 1, is_plain, mesh.comm);
  mesh.vector_map = map_of_dofs(owned, 3, is_plain, mesh.comm);
  mesh.ghosted_map = map_of_dofs(numbers, 1, false, mesh.comm);
  mesh.ghosted_vector_map = map_of_dofs(numbers, 3, false, mesh.comm);
  mesh.import = Teuchos::rcp(new Import(mesh.node_map, mesh.ghosted_map));
  mesh.vector_import = Teuchos::rcp(new Import(mesh.vector_map, mesh.ghosted_vector_map));
}

FieldMesh make_field_mesh(const mesh::Mesh& mesh, const mesh::Partition& partition,
                          const std::vector<int>& regions, const CommPtr& comm) {
  FieldMesh field;
  field.comm = comm;
  for (const mesh::Tag& tag : mesh.regions) field.regions.push_back(tag.name);
  for (const mesh::Tag& tag : mesh.surfaces) field.surfaces.push_back(tag.name);
  std::vector<char> is_in_field(mesh.regions.size(), 0);
  for (const int r : regions) is_in_field[r] = 1;

  const int rank = comm->getRank();
  const Numbering n = number_nodes(mesh, partition, is_in_field, rank, comm->getSize());
  std::vector<int> tets;
  for (std::size_t e = 0; e < mesh.tets.size(); ++e) {
    if (!is_in_field[mesh.tet_region[e]]) continue;
    const auto& t = mesh.tets[e];
    if (partition.tet_part[e] == rank ||
        std::any_of(t.begin(), t.end(), [&](int v) { return partition.vertex_owner[v] == rank; }))
      tets.push_back(static_cast<int>(e));
  }
  const std::vector<int> local = add_nodes(mesh, n, tets, field);
  for (const int e : tets) {
    const auto& t = mesh.tets[e];
    field.tets.push_back({local[t[0]], local[t[1]], local[t[2]], local[t[3]]});
    field.region.push_back(mesh.tet_region[e]);
    field.tet_number.push_back(e + 1);
    field.is_owned.push_back(partition.tet_part[e] == rank);
  }
  for (const mesh::TetVectors& whole : mesh.tet_vectors) {
    auto& mine = field.tet_vectors.emplace_back(mesh::TetVectors{whole.name, {}});
    for (const int e : tets) mine.values.push_back(whole.values[e]);
  }
  add_faces(mesh, partition, is_in_field, local, field);
  std::vector<GlobalOrdinal> numbers;
  for (const int v : field.vertex) numbers.push_back(n.global[v]);
  set_maps(numbers, field);
  return field;
}

int FieldMesh::surface_index(const std::string& name) const {
  const auto found = std::find(surfaces.begin(), surfaces.end(), name);
  return found == surfaces.end() ? -1 : static_cast<int>(found - surfaces.begin());
}

std::vector<int> bounding_surfaces(const FieldMesh& mesh) {
  std::vector<double> faces(mesh.surfaces.size(), 0.0);
  for (const Face& face : mesh.faces) faces[face.surface] += face.is_owned;
  faces = global_sum(*mesh.comm, faces);
  std::vector<int> found;
  for (std::size_t s = 0; s < faces.size(); ++s)
    if (faces[s] > 0.0) found.push_back(static_cast<int>(s));
  return found;
}

namespace {

std::vector<Vec3> nodal_vectors(const Vector& v, int n_nodes) {
  const auto view = v.getLocalViewHost(Tpetra::Access::ReadOnly);
  std::vector<Vec3> values(n_nodes);
  for (int a = 0; a < n_nodes; ++a)
    values[a] = {view(3 * a, 0), view(3 * a + 1, 0), view(3 * a + 2, 0)};
  return values;
}

}  // namespace

std::vector<Vec3> owned_vectors(const FieldMesh& mesh, const Vector& v) {
  return nodal_vectors(v, mesh.n_owned);
}

std::vector<Vec3> ghosted_vectors(const FieldMesh& mesh, const Vector& v) {
  Vector ghosted(mesh.ghosted_vector_map, false);
  ghosted.doImport(v, *mesh.vector_import, Tpetra::INSERT);
  return nodal_vectors(ghosted, mesh.n_nodes());
}

std::vector<double> ghosted_scalars(const FieldMesh& mesh, const Vector& v) {
  Vector ghosted(mesh.ghosted_map, false);
  ghosted.doImport(v, *mesh.import, Tpetra::INSERT);
  const auto view = ghosted.getLocalViewHost(Tpetra::Access::ReadOnly);
  std::vector<double> values(mesh.n_nodes());
  for (int a = 0; a < mesh.n_nodes(); ++a) values[a] = view(a, 0);
  return values;
}

void store(const std::vector<Vec3>& values, const FieldMesh& mesh, Vector& v) {
  const auto view = v.getLocalViewHost(Tpetra::Access::OverwriteAll);
  for (int a = 0; a < mesh.n_owned; ++a)
    for (int i = 0; i < 3; ++i) view(3 * a + i, 0) = values[a][i];
}

}  // namespace tunica::fields
