#include "tunica/assembly/stress_residual.hpp"

#include "tunica/assembly/gather.hpp"
#include "tunica/kernels/deformation.hpp"
#include "tunica/kernels/wall_stress.hpp"

namespace tunica::assembly {

std::vector<Vec3> stress_forces(const PatchRecovery& patches, const fields::FieldMesh& mesh,
                                const SolidElements& elements, const std::vector<Vec3>& d) {
  // Without pressure the Cauchy stress is σ' = J⁻¹ F S' Fᵀ.
  std::vector<double> stress;
  stress.reserve(6 * mesh.tets.size());
  for (std::size_t e = 0; e < mesh.tets.size(); ++e) {
    const Sym3 sigma = kernels::cauchy_stress(
        elements.geometry[e], elements.displacement(e, gather(d, mesh.tets[e])), {},
        *elements.layer(e).law, elements.frame(e), elements.past_of(e));
    stress.insert(stress.end(), sigma.begin(), sigma.end());
  }
  stress = patches.at_nodes(6, stress);
  // J div σ'* = Σ_a σ'*_a J F⁻ᵀ∇N_a, constant on the element
  std::vector<Vec3> forces(mesh.tets.size(), Vec3{});
  for (std::size_t e = 0; e < forces.size(); ++e) {
    const kernels::Tet4 T = elements.geometry[e];
    const Mat3 F =
        kernels::deformation_gradient(T, elements.displacement(e, gather(d, mesh.tets[e])));
    const Mat3 cofactor = transpose(adjugate(F));  // J F⁻ᵀ
    for (int a = 0; a < 4; ++a) {
      Sym3 sigma;
      for (int k = 0; k < 6; ++k) sigma[k] = stress[6 * patches.mesh().tets[e][a] + k];
      forces[e] += kernels::apply(sigma, cofactor * T.grad_N[a]);
    }
  }
  return forces;
}

}  // namespace tunica::assembly
