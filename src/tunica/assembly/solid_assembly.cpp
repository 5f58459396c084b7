#include "tunica/assembly/solid_assembly.hpp"

#include <cmath>

#include "tunica/assembly/gather.hpp"

namespace tunica::assembly {

WorstElement worst_solid_element(const fields::FieldMesh& mesh, const SolidElements& elements,
                                 const std::vector<Vec3>& d) {
  WorstElement worst{1.0, -1};
  for (std::size_t e = 0; e < mesh.tets.size(); ++e) {
    const double J =
        kernels::solid_jacobian_determinant(elements.geometry[e], gather(d, mesh.tets[e]));
    if (worst.element < 0 || !(J >= worst.determinant)) worst = {J, static_cast<int>(e)};
    if (std::isnan(worst.determinant)) break;  // no other element may hide it
  }
  return worst;
}

void assemble_solid(const fields::FieldMesh& mesh, const SolidElements& elements,
                    const SolidFields& state, NodalResidual& R, BlockAssembler* K) {
  kernels::MixedResidual Re;
  kernels::MixedJacobian Ke;
  for (std::size_t e = 0; e < mesh.tets.size(); ++e) {
    const auto& nodes = mesh.tets[e];
    kernels::SolidState s{gather(state.d, nodes), gather(state.p, nodes), gather(state.r, nodes)};
    for (Vec3& r : s.r) r = elements.density[e] * r;
    const kernels::Tet4& T = elements.geometry[e];
    if (K == nullptr) {
      Re = kernels::solid_up_residual(T, s, *elements.law[e], elements.coefficients[e],
                                      elements.frame(e));
    } else {
      kernels::solid_up_jacobian(T, s, *elements.law[e], elements.coefficients[e], Re, Ke,
                                 elements.frame(e));
      K->add(e, Ke);
    }
    R.add(mesh, e, Re);
  }
}

}  // namespace tunica::assembly
