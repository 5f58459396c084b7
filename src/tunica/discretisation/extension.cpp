#include "tunica/discretisation/extension.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <unordered_map>

#include "tunica/algebra/components.hpp"
#include "tunica/assembly/scalar_matrix.hpp"
#include "tunica/base/error.hpp"
#include "tunica/base/reduce.hpp"
#include "tunica/kernels/elastic_p1.hpp"
#include "tunica/kernels/surface_tri3.hpp"

namespace tunica::discretisation {

namespace {

/// What a face and an edge have in place of a volume: a mesh of one size has one γ in all extents.
double volume_of_area(double A) { return std::pow(A, 1.5); }
double volume_of_length(double h) { return std::pow(h, 3.0); }

/// Volumes, or what faces or edges have for them, of what the rank counts.
std::vector<double> sizes_of_owned(const fields::FieldMesh& mesh, Extent extent) {
  std::vector<double> sizes;
  if (extent == Extent::volume) {
    for (std::size_t e = 0; e < mesh.tets.size(); ++e)
      if (mesh.is_owned[e])
        sizes.push_back(kernels::make_tet4(assembly::gather(mesh.x, mesh.tets[e])).volume);
    return sizes;
  }
  for (const fields::Face& face : mesh.faces) {
    if (!face.is_owned) continue;
    const std::array<Vec3, 3> x = assembly::gather(mesh.x, face.nodes);
    if (extent == Extent::surfaces)
      sizes.push_back(volume_of_area(norm(kernels::area_normal(x))));
    else
      for (int k = 0; k < 3; ++k) sizes.push_back(volume_of_length(norm(x[(k + 1) % 3] - x[k])));
  }
  return sizes;
}

/// γ of an element of this volume.
class Stiffness {
public:
  /// Collective.
  Stiffness(const fields::FieldMesh& mesh, Extent extent, double exponent) : exponent_(exponent) {
    if (exponent == 0.0) return;
    // V̄ = Σ V/n over all ranks, so that γ does not depend on how the mesh is distributed
    const std::vector<double> mine = sizes_of_owned(mesh, extent);
    const double count = global_sum(*mesh.comm, static_cast<double>(mine.size()));
    mean_ = global_sum(*mesh.comm, std::accumulate(mine.begin(), mine.end(), 0.0)) / count;
  }
  double operator()(double volume) const {
    return exponent_ == 0.0 ? 1.0 : std::pow(mean_ / volume, exponent_);
  }

private:
  double exponent_, mean_ = 1.0;
};

/// ∫ γ ∇N_a·∇N_b on what a tetrahedron has of the extent: on all of it, or on its sides that are
/// faces of the boundary, or along their edges.
class ElementMatrices {
public:
  /// Collective.
  ElementMatrices(const fields::FieldMesh& mesh, Extent extent, double stiffening)
      : mesh_(&mesh), extent_(extent), stiffness_(mesh, extent, stiffening) {
    // Sides and edges are collected here, as several may belong to one tetrahedron. Matrices of
    // volumes are computed as they are asked for.
    if (extent == Extent::volume) return;
    const Edges lines = extent == Extent::lines ? edges_of_lines(mesh) : Edges{};
    for (const fields::Face& face : mesh.faces) {
      if (extent == Extent::surfaces) add_triangle(face);
      for (int k = 0; k < 3; ++k)  // with both faces of each: the same factor for all
        if (lines.count(edge_of(face, k)) > 0) add_edge(face, k, (k + 1) % 3);
    }
  }

  assembly::ScalarElement operator()(std::size_t e) const {
    if (extent_ == Extent::volume) {
      const kernels::Tet4 T = kernels::make_tet4(assembly::gather(mesh_->x, mesh_->tets[e]));
      assembly::ScalarElement K = kernels::laplace_p1(T);
      const double gamma = stiffness_(T.volume);
      for (auto& row : K)
        for (double& value : row) value *= gamma;
      return K;
    }
    const auto found = sides_.find(e);
    return found == sides_.end() ? assembly::ScalarElement{} : found->second;
  }

private:
  using Corners = std::array<Vec3, 3>;

  /// Where corner k of a face is in its tetrahedron.
  int place(const fields::Face& face, int k) const {
    const auto& nodes = mesh_->tets[face.tet];
    return static_cast<int>(std::find(nodes.begin(), nodes.end(), face.nodes[k]) - nodes.begin());
  }

  // K_ab += γ ∫ ∇_S N_a·∇_S N_b dA at the corners' places in the tetrahedron
  void add_triangle(const fields::Face& face) {
    const Corners x = assembly::gather(mesh_->x, face.nodes);
    const auto L = kernels::laplace_p1(x);
    const double gamma = stiffness_(volume_of_area(norm(kernels::area_normal(x))));
    assembly::ScalarElement& K = sides_[face.tet];
    for (int a = 0; a < 3; ++a)
      for (int b = 0; b < 3; ++b) K[place(face, a)][place(face, b)] += gamma * L[a][b];
  }

  // K += γ/h [1 −1; −1 1], a linear element along the edge
  void add_edge(const fields::Face& face, int k, int l) {
    const double h = norm(mesh_->x[face.nodes[l]] - mesh_->x[face.nodes[k]]);
    const double stiffness = stiffness_(volume_of_length(h)) / h;
    assembly::ScalarElement& K = sides_[face.tet];
    const int a = place(face, k), b = place(face, l);
    K[a][a] += stiffness;
    K[b][b] += stiffness;
    K[a][b] -= stiffness;
    K[b][a] -= stiffness;
  }

  const fields::FieldMesh* mesh_;
  Extent extent_;
  Stiffness stiffness_;
  std::unordered_map<std::size_t, assembly::ScalarElement> sides_;  ///< by local tetrahedron
};

}  // namespace

Edge edge_of(const fields::Face& face, int k) {
  const int a = face.nodes[k], b = face.nodes[(k + 1) % 3];
  return {std::min(a, b), std::max(a, b)};
}

// An edge lies in a line of the boundary where its faces belong to different surfaces.
Edges edges_of_lines(const fields::FieldMesh& mesh) {
  std::map<Edge, int> surface_of;  // of the first face at an edge
  Edges found;
  for (const fields::Face& face : mesh.faces)
    for (int k = 0; k < 3; ++k) {
      const Edge edge = edge_of(face, k);
      if (surface_of.emplace(edge, face.surface).first->second != face.surface) found.insert(edge);
    }
  return found;
}

void Extension::drop_given(MultiVector& F) const {
  const auto view = F.getLocalViewHost(read_write);
  for (int a = 0; a < mesh_->n_owned; ++a)
    for (std::size_t j = 0; j < view.extent(1); ++j)
      if (is_given_[a]) view(a, j) = 0.0;
}

// Two matrices of the same elements: L without the couplings of given nodes is inverted, and the
// whole L makes the right side −L φ_given of the free ones.
HarmonicExtension::HarmonicExtension(const fields::FieldMesh& mesh, std::vector<char> is_given,
                                     Extent extent, double stiffening)
    : Extension(mesh, std::move(is_given)) {
  const fields::NodeGraph graph = fields::make_node_graph(mesh);
  const ElementMatrices element(mesh, extent, stiffening);
  jacobian_ = assembly::scalar_matrix(mesh, graph, element, is_given_);
  laplacian_ = assembly::scalar_matrix(mesh, graph, element, std::vector<char>(mesh.n_nodes(), 0));
}

void HarmonicExtension::residual(const MultiVector& phi, MultiVector& F) const {
  // F = L φ at the free nodes
  laplacian_->apply(phi, F);
  drop_given(F);
}

// K_ab = ∫ γ σ(N_b e_j):ε(N_a e_i) dV in rows 3a + i of owned nodes and columns 3b + j
ElasticExtension::ElasticExtension(const fields::FieldMesh& mesh, std::vector<char> is_given,
                                   Extent extent, double poisson, double stiffening)
    : Extension(mesh, is_given), harmonic_(mesh, std::move(is_given), extent, stiffening),
      matrix_(fields::make_matrix(fields::make_node_graph(mesh), mesh, 3, 3)) {
  TUNICA_ASSERT(extent != Extent::lines, "lines have no elastic law");
  const Stiffness stiffness(mesh, extent, stiffening);
  matrix_->resumeFill();
  if (extent == Extent::volume)
    for (const auto& nodes : mesh.tets) {
      const kernels::Tet4 T = kernels::make_tet4(assembly::gather(mesh.x, nodes));
      add(nodes, kernels::elastic_p1(T, stiffness(T.volume), poisson));
    }
  else
    for (const fields::Face& face : mesh.faces) {
      const auto x = assembly::gather(mesh.x, face.nodes);
      const double gamma = stiffness(volume_of_area(norm(kernels::area_normal(x))));
      add(face.nodes, kernels::elastic_p1(x, gamma, poisson));
    }
  matrix_->fillComplete(mesh.vector_map, mesh.vector_map);
}

// An element between ranks is on both, and each sums the rows of its own nodes.
template <std::size_t n>
void ElasticExtension::add(const std::array<int, n>& nodes,
                           const std::array<std::array<double, 3 * n>, 3 * n>& element) {
  std::array<int, 3 * n> columns;
  for (std::size_t b = 0; b < n; ++b)
    for (int j = 0; j < 3; ++j) columns[3 * b + j] = 3 * nodes[b] + j;
  for (std::size_t a = 0; a < n; ++a) {
    if (nodes[a] >= mesh_->n_owned) continue;
    for (int i = 0; i < 3; ++i)
      matrix_->sumIntoLocalValues(3 * nodes[a] + i,
                                  Teuchos::arrayView(columns.data(), columns.size()),
                                  Teuchos::arrayView(element[3 * a + i].data(), columns.size()));
  }
}

void ElasticExtension::residual(const MultiVector& phi, MultiVector& F) const {
  Vector d(mesh_->vector_map), forces(mesh_->vector_map);
  // F = L d at the free nodes, the components of d from columns to 3a + i and back
  algebra::from_columns(phi, d);
  matrix_->apply(d, forces);
  algebra::to_columns(forces, F);
  drop_given(F);
}

}  // namespace tunica::discretisation
