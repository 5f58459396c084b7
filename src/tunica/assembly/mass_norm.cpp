#include "tunica/assembly/mass_norm.hpp"

#include <cmath>

#include "tunica/assembly/gather.hpp"
#include "tunica/base/reduce.hpp"
#include "tunica/kernels/energy.hpp"

namespace tunica::assembly {

double mass_norm(const fields::FieldMesh& mesh, const fields::FieldMesh& scalar_mesh,
                 const ElementGeometry& geometry, const algebra::BlockVector& x) {
  const std::vector<Vec3> u = fields::ghosted_vectors(mesh, x[0]);
  const std::vector<double> p = fields::ghosted_scalars(scalar_mesh, x[1]);
  // Σ_e ∫ p² + |u|² dV, each element once
  double sum = 0.0;
  for (std::size_t e = 0; e < mesh.tets.size(); ++e) {
    if (!mesh.is_owned[e]) continue;
    const double V = geometry[e].volume;
    sum += kernels::squared_norm(V, gather(p, scalar_mesh.tets[e])) +
           kernels::squared_norm(V, gather(u, mesh.tets[e]));
  }
  return std::sqrt(global_sum(*mesh.comm, sum));
}

}  // namespace tunica::assembly
