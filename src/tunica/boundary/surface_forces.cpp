#include "tunica/boundary/surface_forces.hpp"

namespace tunica::boundary {

void add_face(const fields::FieldMesh& mesh, const fields::Face& face, double area,
              const std::array<Vec3, 3>& force, NodalShares& shares) {
  for (int k = 0; k < 3; ++k) {
    const int pair = mesh.node_surfaces.find(face.nodes[k], face.surface);
    shares.area[pair] += area / 3.0;
    shares.force[pair] += force[k];
  }
}

std::vector<Vec3> shared_reactions(const fields::FieldMesh& mesh, const SurfaceTerms& terms,
                                   const std::vector<Vec3>& reaction, const NodalShares& shares) {
  const fields::NodeSurfaces& on = mesh.node_surfaces;
  const int n_surfaces = static_cast<int>(mesh.surfaces.size());
  std::vector<Vec3> taken(on.size());
  for (int i = 0; i < 3; ++i) {
    std::vector<char> takes(n_surfaces);
    for (int s = 0; s < n_surfaces; ++s)
      takes[s] = terms.prescribes(s, i) || terms.has_held_directions(s);
    for (int a = 0; a < mesh.n_owned; ++a) {
      double area = 0.0, rest = reaction[a][i];
      for (int k = on.begin(a); k < on.end(a); ++k)
        if (takes[on.surface(k)]) {
          area += shares.area[k];
          rest -= shares.force[k][i];
        }
      for (int k = on.begin(a); k < on.end(a); ++k)
        if (takes[on.surface(k)]) taken[k][i] = shares.force[k][i] + shares.area[k] / area * rest;
    }
  }
  return taken;
}

std::vector<Vec3> reaction_forces(const fields::FieldMesh& mesh, const SurfaceTerms& terms,
                                  const std::vector<Vec3>& reaction, const NodalShares& shares) {
  const std::vector<Vec3> taken = shared_reactions(mesh, terms, reaction, shares);
  std::vector<Vec3> total(mesh.surfaces.size());
  for (int a = 0; a < mesh.n_owned; ++a)
    for (int k = mesh.node_surfaces.begin(a); k < mesh.node_surfaces.end(a); ++k)
      total[mesh.node_surfaces.surface(k)] += taken[k];
  return total;
}

}  // namespace tunica::boundary
