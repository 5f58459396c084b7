#pragma once
#include "tunica/boundary/surface_terms.hpp"

namespace tunica::boundary {

/// The motions of a wall as a rigid body that nothing on its surfaces resists to first order, in
/// words: "sliding in x and y, and turning about z"; empty where all six are held. Equilibria of
/// such a wall are singular.
///
///   M = Σ_k m_k m_kᵀ,   m_k = (ℓ_k(φ_1), …, ℓ_k(φ_6)),      free: the null space of M
///
///   φ    three translations, and three rotations about the middle, of length 1 on the mean
///   ℓ_k  what is prescribed: components and directions at nodes, differences within surfaces that
///        move as one, displacements that springs resist at the corners of faces
///
/// terms: on the mesh. Collective.
std::string free_rigid_motions(const SurfaceTerms& terms, const fields::FieldMesh& mesh);

}  // namespace tunica::boundary
