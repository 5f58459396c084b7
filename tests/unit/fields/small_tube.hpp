#pragma once
#include <Teuchos_DefaultSerialComm.hpp>
#include <Tpetra_Core.hpp>
#include <cmath>
#include <vector>

#include "tunica/base/reduce.hpp"
#include "tunica/fields/block_operator.hpp"
#include "tunica/mesh/distributed/share.hpp"
#include "tunica/mesh/tube.hpp"
#include "tunica/mesh/validate.hpp"

namespace tunica::test {

inline CommPtr world() { return Tpetra::getDefaultComm(); }
/// Each rank on its own: the reference for what must not depend on the ranks.
inline CommPtr alone() { return Teuchos::rcp(new Teuchos::SerialComm<int>); }

/// The calling rank's share of a mesh that rank 0 has.
inline mesh::Share share_of(const mesh::Mesh& mesh, const std::vector<bool>& region_is_fluid,
                            const CommPtr& comm = world()) {
  return mesh::share_of(mesh::slab_of(mesh, comm), region_is_fluid, mesh::Partitioner::automatic,
                        "mesh");
}

/// A tube of a few hundred tetrahedra with both fields and two layers, distributed.
struct SmallTube {
  explicit SmallTube(const CommPtr& comm = world(), const mesh::Tube& shape = options())
      : mesh(mesh::make_tube(shape)), share(share_of(mesh, {true, false, false}, comm)),
        fluid(fields::make_field_mesh(share, {0})), wall(fields::make_field_mesh(share, {1, 2})) {}

  static mesh::Tube options() {
    mesh::Tube tube;
    tube.around = 8;
    tube.axial = 3;
    tube.length = 3.0;
    tube.media_layers = tube.adventitia_layers = 1;
    return tube;
  }
  int surface(const std::string& name) const { return mesh::surface_index(mesh, name); }

  mesh::Mesh mesh;
  mesh::Share share;
  fields::FieldMesh fluid, wall;
};

/// Numbers without pattern in (-1, 1), the same wherever their key is the same.
inline double scatter(double key) {
  const double s = std::sin(12.9898 * key + 0.618) * 43758.5453;
  return 2.0 * (s - std::floor(s)) - 1.0;
}

/// Sets each entry to f(vertex, component); the scalar is component 3.
template <class Function>
algebra::BlockVector block_vector(const fields::FieldMesh& mesh, Function f) {
  algebra::BlockVector x = fields::zero_vector(mesh);
  const auto u = x[0].getLocalViewHost(Tpetra::Access::OverwriteAll);
  const auto p = x[1].getLocalViewHost(Tpetra::Access::OverwriteAll);
  for (int a = 0; a < mesh.n_owned; ++a) {
    for (int i = 0; i < 3; ++i) u(3 * a + i, 0) = f(mesh.vertex[a], i);
    p(a, 0) = f(mesh.vertex[a], 3);
  }
  return x;
}

inline algebra::BlockVector scattered(const fields::FieldMesh& mesh, int seed, double size = 1.0) {
  return block_vector(mesh, [=](int vertex, int i) {
    return size * scatter(1000.0 * seed + 4.0 * vertex + i + 0.37 * seed);
  });
}

using algebra::norm;

/// |a − b| / |b|
inline double relative_difference(const algebra::BlockVector& a, const algebra::BlockVector& b) {
  algebra::BlockVector c(a.space());
  c.assign(a);
  c[0].update(-1.0, b[0], 1.0);
  c[1].update(-1.0, b[1], 1.0);
  return norm(c) / norm(b);
}

/// y ← a x + y
inline void add(double a, const algebra::BlockVector& x, algebra::BlockVector& y) {
  y[0].update(a, x[0], 1.0);
  y[1].update(a, x[1], 1.0);
}

/// The values of a distributed block vector by vertex of the mesh, on every rank: 4 v + i.
inline std::vector<double> by_vertex(const fields::FieldMesh& mesh, const algebra::BlockVector& x,
                                     std::size_t vertices) {
  std::vector<double> mine(4 * vertices, 0.0), all(4 * vertices, 0.0);
  const auto u = x[0].getLocalViewHost(Tpetra::Access::ReadOnly);
  const auto p = x[1].getLocalViewHost(Tpetra::Access::ReadOnly);
  for (int a = 0; a < mesh.n_owned; ++a) {
    for (int i = 0; i < 3; ++i) mine[4 * mesh.vertex[a] + i] = u(3 * a + i, 0);
    mine[4 * mesh.vertex[a] + 3] = p(a, 0);
  }
  Teuchos::reduceAll(*mesh.comm, Teuchos::REDUCE_SUM, static_cast<int>(mine.size()), mine.data(),
                     all.data());
  return all;
}

inline double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
  double largest = a.size() == b.size() ? 0.0 : 1e300;
  for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, std::abs(a[i] - b[i]));
  return largest;
}

}  // namespace tunica::test
