#include "tunica/problems/surface_radius.hpp"

#include <algorithm>
#include <cmath>

#include "tunica/assembly/gather.hpp"
#include "tunica/base/reduce.hpp"
#include "tunica/kernels/surface_tri3.hpp"

namespace tunica::problems {

// ∇N_a of a triangle is (n × e_a)/2A with the edge e_a opposite to a.

double surface_radius(const fields::FieldMesh& mesh, const std::vector<int>& surfaces) {
  const auto counts = [&](const fields::Face& face) {
    return std::count(surfaces.begin(), surfaces.end(), face.surface) > 0;
  };
  // n_a = Σ_T A_T n_T / |Σ_T A_T n_T|, as owners see them
  std::vector<Vec3> normals(mesh.n_owned);
  for (const fields::Face& face : mesh.faces) {
    if (!counts(face)) continue;
    const Vec3 n = kernels::area_normal(assembly::gather(mesh.x, face.nodes));
    for (const int a : face.nodes)
      if (a < mesh.n_owned) normals[a] += n;
  }
  for (Vec3& n : normals)
    if (norm(n) > 0.0) n = unit(n);
  normals = fields::ghosted_vectors(mesh, normals);
  // ∫ ∇_S·n dA = Σ_T Σ_a A ∇N_a·n_a = ½ Σ_T Σ_a (n × e_a)·n_a
  double area = 0.0, curvature = 0.0;
  for (const fields::Face& face : mesh.faces) {
    if (!face.is_owned || !counts(face)) continue;
    const auto x = assembly::gather(mesh.x, face.nodes);
    const Vec3 n = kernels::area_normal(x);
    area += norm(n);
    for (int a = 0; a < 3; ++a)
      curvature +=
          0.5 * dot(cross(unit(n), x[(a + 2) % 3] - x[(a + 1) % 3]), normals[face.nodes[a]]);
  }
  area = global_sum(*mesh.comm, area);
  curvature = std::abs(global_sum(*mesh.comm, curvature));
  // r = A/|∫ ∇_S·n dA|; flat surfaces have none, and A^½ in its place
  return std::min(std::sqrt(area), area / std::max(curvature, 1e-300));
}

}  // namespace tunica::problems
