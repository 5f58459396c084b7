#include "assembly/mass_norm.hpp"

#include <cmath>

#include "assembly/gather.hpp"
#include "fields/reduce.hpp"

namespace tunica::assembly {

namespace {

/// vᵀ M v on one element with M_ab = V/20 (1 + δ_ab).
double quadratic(double volume, const std::array<double, 4>& v) {
  const double sum = v[0] + v[1] + v[2] + v[3];
  const double squares = v[0] * v[0] + v[1] * v[1] + v[2] * v[2] + v[3] * v[3];
  return volume / 20.0 * (sum * sum + squares);
}

}  // namespace

double mass_norm(const fields::FieldMesh& mesh, const std::vector<kernels::Tet4>& geometry,
                 const fields::BlockVector& x) {
  const std::vector<Vec3> u = fields::ghosted_vectors(mesh, *x.u);
  const std::vector<double> p = fields::ghosted_scalars(mesh, *x.p);
  double sum = 0.0;
  for (std::size_t e = 0; e < mesh.tets.size(); ++e) {
    if (!mesh.is_counted[e]) continue;
    const auto nodes = mesh.tets[e];
    const double V = geometry[e].volume;
    sum += quadratic(V, gather(p, nodes));
    for (int i = 0; i < 3; ++i)
      sum += quadratic(V, {u[nodes[0]][i], u[nodes[1]][i], u[nodes[2]][i], u[nodes[3]][i]});
  }
  return std::sqrt(fields::global_sum(*mesh.comm, sum));
}

std::vector<kernels::Tet4> geometry_of(const fields::FieldMesh& mesh, const std::vector<Vec3>& x) {
  std::vector<kernels::Tet4> geometry;
  geometry.reserve(mesh.tets.size());
  for (const auto& nodes : mesh.tets) geometry.push_back(kernels::make_tet4(gather(x, nodes)));
  return geometry;
}

}  // namespace tunica::assembly
