#include "tunica/assembly/mass_norm.hpp"

#include <cmath>

#include "tunica/assembly/gather.hpp"
#include "tunica/base/reduce.hpp"
#include "tunica/kernels/energy.hpp"

namespace tunica::assembly {

double mass_norm(const fields::FieldMesh& mesh, const fields::FieldMesh& scalar_mesh,
                 const std::vector<kernels::Tet4>& geometry, const algebra::BlockVector& x) {
  const std::vector<Vec3> u = fields::ghosted_vectors(mesh, x[0]);
  const std::vector<double> p = fields::ghosted_scalars(scalar_mesh, x[1]);
  double sum = 0.0;
  for (std::size_t e = 0; e < mesh.tets.size(); ++e) {
    if (!mesh.is_owned[e]) continue;
    const double V = geometry[e].volume;
    sum += kernels::squared_norm(V, gather(p, scalar_mesh.tets[e])) +
           kernels::squared_norm(V, gather(u, mesh.tets[e]));
  }
  return std::sqrt(global_sum(*mesh.comm, sum));
}

std::vector<kernels::Tet4> geometry_of(const fields::FieldMesh& mesh, const std::vector<Vec3>& x) {
  std::vector<kernels::Tet4> geometry;
  geometry.reserve(mesh.tets.size());
  for (const auto& nodes : mesh.tets) geometry.push_back(kernels::make_tet4(gather(x, nodes)));
  return geometry;
}

}  // namespace tunica::assembly
