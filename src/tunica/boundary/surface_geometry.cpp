#include "tunica/boundary/surface_geometry.hpp"

#include <algorithm>
#include <cmath>

#include "tunica/assembly/gather.hpp"
#include "tunica/base/reduce.hpp"
#include "tunica/kernels/surface_tri3.hpp"

namespace tunica::boundary {

SurfaceGeometry surface_geometry(const fields::FieldMesh& mesh, int surface) {
  double area = 0.0, radius = 0.0, bend = 0.0;
  Vec3 moment{}, normal{};
  for (const fields::Face& face : mesh.faces) {
    if (face.surface != surface || !face.is_owned) continue;
    const auto x = assembly::gather(mesh.x, face.nodes);
    const Vec3 An = kernels::area_normal(x);
    const double A = norm(An);
    area += A;
    normal += An;
    moment += A / 3.0 * (x[0] + x[1] + x[2]);
  }
  area = global_sum(*mesh.comm, area);
  for (double& m : moment) m = global_sum(*mesh.comm, m) / area;
  for (double& n : normal) n = global_sum(*mesh.comm, n);
  if (norm(normal) > 1e-12 * area)
    normal = unit(normal);
  else
    bend = std::acos(-1.0);  // closed, or two that look away from each other
  for (const fields::Face& face : mesh.faces) {
    if (face.surface != surface) continue;
    const Vec3 An = kernels::area_normal(assembly::gather(mesh.x, face.nodes));
    bend = std::max(bend, std::atan2(norm(cross(An, normal)), dot(An, normal)));
  }
  for (int a = 0; a < mesh.n_owned; ++a)
    if (mesh.is_on(a, surface)) radius = std::max(radius, norm(mesh.x[a] - moment));
  return {area, moment, global_max(*mesh.comm, radius), normal, global_max(*mesh.comm, bend)};
}

std::vector<Vec3> nodal_areas(const fields::FieldMesh& mesh, const std::vector<Vec3>& positions,
                              const std::vector<int>& surfaces) {
  std::vector<Vec3> area(mesh.n_owned);
  for (const fields::Face& face : mesh.faces) {
    if (std::find(surfaces.begin(), surfaces.end(), face.surface) == surfaces.end()) continue;
    const Vec3 third = 1.0 / 3.0 * kernels::area_normal(assembly::gather(positions, face.nodes));
    for (const int a : face.nodes)
      if (a < mesh.n_owned) area[a] += third;
  }
  return area;
}

}  // namespace tunica::boundary
