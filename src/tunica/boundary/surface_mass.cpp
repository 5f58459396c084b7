#include "tunica/boundary/surface_mass.hpp"

#include <algorithm>

#include "tunica/assembly/gather.hpp"
#include "tunica/kernels/surface_tri3.hpp"

namespace tunica::boundary {

namespace {

/// D⁻¹ x on owned nodes.
std::vector<Vec3> over_area(const std::vector<double>& D, std::vector<Vec3> x) {
  for (std::size_t a = 0; a < x.size(); ++a) x[a] = D[a] > 0.0 ? 1.0 / D[a] * x[a] : Vec3{};
  return x;
}

}  // namespace

std::vector<Vec3> surface_density(const fields::FieldMesh& mesh, const std::vector<Vec3>& positions,
                                  const std::vector<int>& surfaces,
                                  const std::vector<Vec3>& force) {
  const auto area_of = [&](const fields::Face& face) {
    if (std::find(surfaces.begin(), surfaces.end(), face.surface) == surfaces.end()) return 0.0;
    return norm(kernels::area_normal(assembly::gather(positions, face.nodes)));
  };
  std::vector<double> D(mesh.n_owned, 0.0);
  for (const fields::Face& face : mesh.faces)
    for (const int a : face.nodes)
      if (a < mesh.n_owned) D[a] += area_of(face) / 3.0;
  const std::vector<Vec3> t = fields::ghosted_vectors(mesh, over_area(D, force));
  std::vector<Vec3> Mt(mesh.n_owned);
  for (const fields::Face& face : mesh.faces) {
    const double m = area_of(face) / 12.0;
    const Vec3 sum = t[face.nodes[0]] + t[face.nodes[1]] + t[face.nodes[2]];
    for (const int a : face.nodes)
      if (a < mesh.n_owned) Mt[a] += m * (sum + t[a]);
  }
  return over_area(D, Mt);
}

}  // namespace tunica::boundary
