#pragma once
#include "tunica/assembly/patch_recovery.hpp"
#include "tunica/assembly/solid_assembly.hpp"

namespace tunica::assembly {

/// J div σ', the force of the wall's stress without its pressure, per volume where the element is
/// free of stress [kPa/mm]. On linear elements σ' is constant and has none; here it is the
/// divergence of what PatchRecovery makes of it at the vertices:
///
///   J Σ_a σ'_a F⁻ᵀ∇N_a,     σ' = J⁻¹ F S' Fᵀ
///
/// d: displacement of owned and ghost nodes. Patches are those of the pressures, between which σ'
/// jumps. Exact inside regular meshes where σ' is linear; next to the boundary of the right size,
/// but not convergent, as viscous_forces(). Source: [JCWS99]. Collective.
std::vector<Vec3> stress_forces(const PatchRecovery& patches, const fields::FieldMesh& mesh,
                                const SolidElements& elements, const std::vector<Vec3>& d);

}  // namespace tunica::assembly
