#pragma once
#include "tunica/boundary/surface_terms.hpp"

namespace tunica::boundary {

/// Share of each node in every surface that it lies on, by the pairs of FieldMesh::node_surfaces.
/// Complete at owned nodes.
struct NodalShares {
  explicit NodalShares(const fields::FieldMesh& mesh)
      : area(mesh.node_surfaces.size(), 0.0), force(mesh.node_surfaces.size()) {}

  std::vector<double> area;  ///< a third of each triangle around the node [mm²]
  std::vector<Vec3> force;   ///< an estimate of the field's force on the surface [mN]
};

/// Adds a triangle: its area, and a force on each of its nodes.
void add_face(const fields::FieldMesh& mesh, const fields::Face& face, double area,
              const std::array<Vec3, 3>& force, NodalShares& shares);

/// Share of each surface in the reactions of the owned nodes, by the pairs of
/// FieldMesh::node_surfaces, see reaction_forces() [mN].
std::vector<Vec3> shared_reactions(const fields::FieldMesh& mesh, const SurfaceTerms& terms,
                                   const std::vector<Vec3>& reaction, const NodalShares& shares);

/// The field's forces on the surfaces that prescribe its vector unknown, this rank's part, by the
/// reactions r of owned nodes [mN]. A surface takes no more of a reaction than the part along what
/// it holds, a plane that is held along its normal nothing along itself:
///
///   r_a[s] = H_s (e_a[s] + A_a[s] M⁻¹ (r_a − Σ_t H_t e_a[t])),   M = Σ_t A_a[t] H_t
///
///   e   shares.force, the estimate   mN      A   shares.area   mm²
///   H   projector onto what the surface holds; t is over the surfaces of the node that hold
///       anything, and M is inverted on what they hold together
///
/// Where no such surfaces meet, that is all of r_a, whatever the estimate. The forces of all
/// surfaces add up to the sum of the reactions.
std::vector<Vec3> reaction_forces(const fields::FieldMesh& mesh, const SurfaceTerms& terms,
                                  const std::vector<Vec3>& reaction, const NodalShares& shares);

}  // namespace tunica::boundary
