#include "tunica/fields/field_mesh.hpp"

#include <algorithm>
#include <map>

#include "tunica/base/reduce.hpp"
#include "tunica/mesh/distributed/share.hpp"
#include "tunica/mesh/faces.hpp"

namespace tunica::fields {

namespace {

using Triple = std::array<int, 3>;

Triple sorted(Triple t) {
  std::sort(t.begin(), t.end());
  return t;
}

constexpr GlobalOrdinal absent = -1;

/// Numbers of the field's nodes at the vertices of a share: contiguous on each rank. A ghost has
/// one wherever its owner knows it as a vertex of the field.
std::vector<GlobalOrdinal> number_nodes(const mesh::Share& share, const std::vector<char>& is_in) {
  const mesh::Mesh& mesh = share.mesh;
  std::vector<GlobalOrdinal> numbers(mesh.vertices.size(), absent);
  for (std::size_t e = 0; e < mesh.tets.size(); ++e)
    if (is_in[mesh.tet_region[e]])
      for (const int v : mesh.tets[e]) numbers[v] = 0;
  const auto is_mine = [&](std::size_t v) { return share.is_owned[v] && numbers[v] != absent; };
  long long mine = 0;
  for (std::size_t v = 0; v < numbers.size(); ++v) mine += is_mine(v);
  GlobalOrdinal next = sum_before(*share.comm, mine);
  for (std::size_t v = 0; v < numbers.size(); ++v)
    if (is_mine(v)) numbers[v] = next++;
  share.ghosts.update(numbers);
  return numbers;
}

/// Adds the rank's nodes: owned ones in order, ghosts by their global number. Returns the node at
/// each vertex of the share.
std::vector<int> add_nodes(const mesh::Share& share, const std::vector<GlobalOrdinal>& numbers,
                           const std::vector<int>& tets, FieldMesh& field) {
  std::vector<int> local(numbers.size(), -1), nodes;
  for (std::size_t v = 0; v < numbers.size(); ++v)
    if (share.is_owned[v] && numbers[v] != absent) {
      local[v] = static_cast<int>(nodes.size());
      nodes.push_back(static_cast<int>(v));
    }
  field.n_owned = static_cast<int>(nodes.size());
  for (const int e : tets)
    for (const int v : share.mesh.tets[e])
      if (local[v] < 0) {
        local[v] = 0;
        nodes.push_back(v);
      }
  std::sort(nodes.begin() + field.n_owned, nodes.end(),
            [&numbers](int a, int b) { return numbers[a] < numbers[b]; });
  field.vertex.reserve(nodes.size());
  field.x.reserve(nodes.size());
  for (std::size_t a = 0; a < nodes.size(); ++a) {
    local[nodes[a]] = static_cast<int>(a);
    field.vertex.push_back(share.numbers.vertices[nodes[a]]);
    field.x.push_back(share.mesh.vertices[nodes[a]]);
  }
  return local;
}

/// Which of the share's triangles bound the field. A triangle between two tetrahedra of the field,
/// as on a layer boundary, is none of them.
std::vector<int> boundary_of(const mesh::Share& share, const std::vector<char>& is_in) {
  std::vector<int> triangles;
  for (std::size_t i = 0; i < share.mesh.triangles.size(); ++i)
    if (share.is_between(i, is_in)) triangles.push_back(static_cast<int>(i));
  return triangles;
}

/// The surfaces that the nodes lie on. The owner of a vertex knows all triangles around it and
/// tells the others.
NodeSurfaces surfaces_of_nodes(const mesh::Share& share, const std::vector<int>& boundary,
                               const std::vector<int>& local, int n_nodes) {
  const mesh::Mesh& mesh = share.mesh;
  std::vector<std::pair<int, int>> at_vertices;
  for (const int i : boundary)
    for (const int v : mesh.triangles[i])
      if (share.is_owned[v]) at_vertices.emplace_back(v, mesh.triangle_surface[i]);
  const NodeSurfaces owned(static_cast<int>(mesh.vertices.size()), std::move(at_vertices));
  int most = 0;
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v)
    most = std::max(most, owned.end(static_cast<int>(v)) - owned.begin(static_cast<int>(v)));
  most = static_cast<int>(global_max(*share.comm, most));
  std::vector<std::pair<int, int>> pairs;
  std::vector<int> surface(mesh.vertices.size());
  for (int k = 0; k < most; ++k) {
    for (std::size_t v = 0; v < surface.size(); ++v) {
      const int pair = owned.begin(static_cast<int>(v)) + k;
      surface[v] = pair < owned.end(static_cast<int>(v)) ? owned.surface(pair) : -1;
    }
    share.ghosts.update(surface);
    for (std::size_t v = 0; v < surface.size(); ++v)
      if (surface[v] >= 0 && local[v] >= 0) pairs.emplace_back(local[v], surface[v]);
  }
  return {n_nodes, std::move(pairs)};
}

/// A tetrahedron of the field at a boundary triangle.
struct Beside {
  int surface;
  int tet = -1;
  Triple outward{};
};

/// Boundary triangles at nodes of the rank or on tetrahedra of its part. tets: those of the field.
void add_faces(const mesh::Share& share, const std::vector<int>& boundary,
               const std::vector<int>& tets, const std::vector<int>& local, FieldMesh& field) {
  const mesh::Mesh& mesh = share.mesh;
  std::map<Triple, Beside> besides;
  for (const int i : boundary)
    besides[sorted(mesh.triangles[i])].surface = mesh.triangle_surface[i];
  for (std::size_t e = 0; e < tets.size(); ++e)
    for (const auto& f : mesh::tet_faces) {
      const auto& tet = mesh.tets[tets[e]];
      const Triple face{tet[f[0]], tet[f[1]], tet[f[2]]};
      const auto found = besides.find(sorted(face));
      if (found == besides.end()) continue;
      found->second.tet = static_cast<int>(e);
      found->second.outward = face;
    }
  for (const auto& [vertices, beside] : besides) {
    if (beside.tet < 0) continue;
    Face face{{}, beside.surface, share.counts(tets[beside.tet]), beside.tet};
    bool touches_owned = face.is_owned;
    for (int k = 0; k < 3; ++k) {
      face.nodes[k] = local[beside.outward[k]];
      touches_owned = touches_owned || face.nodes[k] < field.n_owned;
    }
    if (touches_owned) field.faces.push_back(face);
  }
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
  const GlobalOrdinal first = sum_before(comm, static_cast<long long>(numbers.size()));
  bool is_mine = true;
  for (std::size_t i = 0; i < numbers.size(); ++i)
    is_mine &= numbers[i] == first + static_cast<GlobalOrdinal>(i);
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

FieldMesh make_field_mesh(const mesh::Share& share, const std::vector<int>& regions) {
  const mesh::Mesh& mesh = share.mesh;
  FieldMesh field;
  field.comm = share.comm;
  for (const mesh::Tag& tag : mesh.regions) field.regions.push_back(tag.name);
  for (const mesh::Tag& tag : mesh.surfaces) field.surfaces.push_back(tag.name);
  const std::vector<char> is_in = mesh::marked_regions(mesh, regions);

  std::vector<int> tets;
  for (std::size_t e = 0; e < mesh.tets.size(); ++e)
    if (is_in[mesh.tet_region[e]]) tets.push_back(static_cast<int>(e));
  const std::vector<GlobalOrdinal> vertex_numbers = number_nodes(share, is_in);
  const std::vector<int> local = add_nodes(share, vertex_numbers, tets, field);
  field.tets.reserve(tets.size());
  field.region.reserve(tets.size());
  field.tet_number.reserve(tets.size());
  field.is_owned.reserve(tets.size());
  for (const int e : tets) {
    const auto& t = mesh.tets[e];
    field.tets.push_back({local[t[0]], local[t[1]], local[t[2]], local[t[3]]});
    field.region.push_back(mesh.tet_region[e]);
    field.tet_number.push_back(share.numbers.tets[e] + 1);
    field.is_owned.push_back(share.counts(e));
  }
  for (const mesh::TetVectors& all : mesh.tet_vectors) {
    auto& mine = field.tet_vectors.emplace_back(mesh::TetVectors{all.name, {}});
    mine.values.reserve(tets.size());
    for (const int e : tets) mine.values.push_back(all.values[e]);
  }
  const std::vector<int> boundary = boundary_of(share, is_in);
  field.node_surfaces = surfaces_of_nodes(share, boundary, local, field.n_nodes());
  add_faces(share, boundary, tets, local, field);
  std::vector<GlobalOrdinal> numbers(field.vertex.size());
  for (std::size_t v = 0; v < local.size(); ++v)
    if (local[v] >= 0) numbers[local[v]] = vertex_numbers[v];
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

std::vector<Vec3> ghosted_vectors(const FieldMesh& mesh, const std::vector<Vec3>& values) {
  Vector owned(mesh.vector_map);
  store(values, mesh, owned);
  return ghosted_vectors(mesh, owned);
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
