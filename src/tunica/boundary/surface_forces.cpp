#include "tunica/boundary/surface_forces.hpp"

#include "tunica/boundary/surface_geometry.hpp"

namespace tunica::boundary {

void add_face(const fields::FieldMesh& mesh, const fields::Face& face, double area,
              const std::array<Vec3, 3>& force, NodalShares& shares) {
  for (int k = 0; k < 3; ++k) {
    const int pair = mesh.node_surfaces.find(face.nodes[k], face.surface);
    shares.area[pair] += area / 3.0;
    shares.force[pair] += force[k];
  }
}

namespace {

/// H = I − P of a surface.
Mat3 held_projector(const SurfaceTerms& terms, int surface) {
  Mat3 H{};
  for (int i = 0; i < 3; ++i) {
    Vec3 e{};
    e[i] = 1.0;
    H[i] = e - terms.free_part(surface, e);
  }
  return H;
}

/// P, what is free where all these hold.
Mat3 free_projector(const std::vector<int>& surfaces, const std::vector<Mat3>& held) {
  assembly::Constraints fixed(1);
  for (const int s : surfaces)
    for (const Vec3& row : held[s])
      if (const double length = norm(row); length > flat)
        fixed.fix_direction(0, 1.0 / length * row);
  return fixed.projector(0);
}

/// M = Σ A H + ΣA P of a node's pairs: its inverse is that of Σ A H on what they hold, and P
/// keeps it regular on the rest.
Mat3 matrix_of_shares(const std::vector<int>& pairs, const std::vector<Mat3>& held,
                      const fields::NodeSurfaces& on, const Mat3& P, const NodalShares& shares) {
  Mat3 M{};
  for (const int k : pairs)
    for (int i = 0; i < 3; ++i) M[i] += shares.area[k] * (held[on.surface(k)][i] + P[i]);
  return M;
}

}  // namespace

std::vector<Vec3> shared_reactions(const fields::FieldMesh& mesh, const SurfaceTerms& terms,
                                   const std::vector<Vec3>& reaction, const NodalShares& shares) {
  const fields::NodeSurfaces& on = mesh.node_surfaces;
  std::vector<Mat3> held;
  std::vector<char> holds;
  for (int s = 0; s < static_cast<int>(mesh.surfaces.size()); ++s) {
    held.push_back(held_projector(terms, s));
    holds.push_back(terms.is_natural(s) ? 0 : 1);
  }
  std::vector<Vec3> taken(on.size());
  std::vector<int> pairs, surfaces;  // of a node
  for (int a = 0; a < mesh.n_owned; ++a) {
    pairs.clear();
    surfaces.clear();
    for (int k = on.begin(a); k < on.end(a); ++k)
      if (holds[on.surface(k)]) {
        pairs.push_back(k);
        surfaces.push_back(on.surface(k));
      }
    if (pairs.size() == 1) taken[pairs[0]] = held[surfaces[0]] * reaction[a];
    if (pairs.size() < 2) continue;
    Vec3 rest = reaction[a];
    for (const int k : pairs) {
      taken[k] = held[on.surface(k)] * shares.force[k];
      rest = rest - taken[k];
    }
    const Mat3 M = matrix_of_shares(pairs, held, on, free_projector(surfaces, held), shares);
    const Vec3 density = 1.0 / det(M) * (adjugate(M) * rest);
    for (const int k : pairs) taken[k] += shares.area[k] * (held[on.surface(k)] * density);
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
