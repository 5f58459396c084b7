#include "tunica/assembly/solid_assembly.hpp"

#include <cmath>

#include "tunica/assembly/gather.hpp"

namespace tunica::assembly {

namespace {

kernels::SolidState state_of(const SolidFields& s, const fields::FieldMesh& mesh,
                             const SolidElements& elements, std::size_t e) {
  const std::array<int, 4>& nodes = mesh.tets[e];
  const double density = elements.density[e];
  const auto& pressure_nodes = fields::scalar_mesh(mesh, elements.split).tets[e];
  kernels::SolidState state{gather(s.d, nodes), gather(s.p, pressure_nodes), gather(s.r, nodes)};
  for (Vec3& r : state.r) r = density * r;
  if (!s.subscale_r.empty()) state.subscale_r = density * s.subscale_r[e];
  return state;
}

}  // namespace

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

std::vector<Vec3> solid_subscales(const fields::FieldMesh& mesh, const SolidElements& elements,
                                  const SolidFields& state) {
  std::vector<Vec3> subscales(mesh.tets.size());
  for (std::size_t e = 0; e < subscales.size(); ++e)
    subscales[e] = kernels::solid_subscale(elements.geometry[e], state_of(state, mesh, elements, e),
                                           elements.coefficients[e]);
  return subscales;
}

void assemble_solid(const fields::FieldMesh& mesh, const SolidElements& elements,
                    const SolidFields& state, NodalResidual& R, BlockAssembler* K) {
  kernels::MixedResidual Re;
  kernels::MixedJacobian Ke;
  for (std::size_t e = 0; e < mesh.tets.size(); ++e) {
    const kernels::SolidState s = state_of(state, mesh, elements, e);
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
