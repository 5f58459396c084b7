#include "tunica/assembly/fluid_assembly.hpp"

#include "tunica/assembly/gather.hpp"
#include "tunica/kernels/fluid_tau.hpp"
#include "tunica/kernels/viscosity.hpp"

namespace tunica::assembly {

kernels::FluidState state_of(const FluidFields& s, const fields::FieldMesh& mesh, std::size_t e) {
  const std::array<int, 4>& nodes = mesh.tets[e];
  kernels::FluidState state;
  state.u = gather(s.u, nodes);
  state.p = gather(s.p, nodes);
  state.u_old = gather(s.u_old, nodes);
  state.w = gather(s.w, nodes);
  state.f = gather(s.f, nodes);
  if (!s.on_wall.empty()) state.on_wall = gather(s.on_wall, nodes);
  // ũ' = 0 and q = 0 where they are left out
  if (!s.subscale.empty()) state.subscale = s.subscale[e];
  if (!s.viscous.empty()) state.viscous = s.viscous[e];
  return state;
}

// R ← R + Σ_e R_e, K ← K + Σ_e K_e, the kernels for all elements of a pack at once, one in each
// lane. The rows of K that they go to are fetched while the kernels run.
void assemble_fluid(const fields::FieldMesh& mesh, const FluidElements& elements,
                    const FluidFields& state, NodalResidual& R, BlockAssembler* K) {
  std::array<Vec3Of<Pack>, 4> x;
  kernels::FluidStateOf<Pack> s;
  Pack tau;
  kernels::MixedResidualOf<Pack> Re;
  kernels::MixedJacobianOf<Pack> Ke;
  for (std::size_t first = 0; first < mesh.tets.size(); first += Pack::size) {
    const PackedElements pack(first, mesh.tets.size());
    if (K != nullptr) K->begin(pack);
    for (int lane = 0; lane < Pack::size; ++lane) {
      const std::size_t e = pack.number[lane];
      set_lane(x, lane, elements.geometry.vertices(e));
      set_lane(s, lane, state_of(state, mesh, e));
      set_lane(tau, lane, elements.tau[e]);
    }
    const auto T = kernels::make_tet4(x);
    if (K == nullptr) {
      kernels::fluid_up_residual(T, s, elements.coefficients, tau, Re);
    } else {
      kernels::fluid_up_jacobian(T, s, elements.coefficients, tau, Re, Ke);
      K->add(Ke);
    }
    R.add(mesh, pack, Re);
  }
}

// μ(γ̇) with γ̇² = 2 ε:ε, constant on an element as ∇u is
std::vector<double> fluid_viscosities(const fields::FieldMesh& mesh, const FluidElements& elements,
                                      const std::vector<Vec3>& u) {
  std::vector<double> mu(mesh.tets.size());
  for (std::size_t e = 0; e < mu.size(); ++e)
    mu[e] = kernels::viscosity_at(*elements.coefficients.viscosity,
                                  kernels::gradient(elements.geometry[e], gather(u, mesh.tets[e])))
                .value;
  return mu;
}

// τ(c₀, h, μ) with c₀ = mean of u − w over the vertices
std::vector<double> fluid_taus(const fields::FieldMesh& mesh, const FluidElements& elements,
                               const std::vector<Vec3>& u, const std::vector<Vec3>& w) {
  std::vector<double> tau(mesh.tets.size());
  for (std::size_t e = 0; e < tau.size(); ++e) {
    Vec3 c{};
    for (const int a : mesh.tets[e]) c += 0.25 * (u[a] - w[a]);
    tau[e] =
        kernels::fluid_tau(elements.geometry[e], c, elements.viscosity[e], elements.coefficients);
  }
  return tau;
}

// u' = −(τ/ρ) mean(m + h)
std::vector<Vec3> fluid_subscales(const fields::FieldMesh& mesh, const FluidElements& elements,
                                  const FluidFields& state) {
  std::vector<Vec3> subscales(mesh.tets.size());
  for (std::size_t e = 0; e < subscales.size(); ++e)
    subscales[e] = kernels::fluid_subscale(elements.geometry[e], state_of(state, mesh, e),
                                           elements.coefficients, elements.tau[e]);
  return subscales;
}

// P_τ = Σ_e over owned elements
double stabilisation_power(const fields::FieldMesh& mesh, const FluidElements& elements,
                           const FluidFields& state) {
  double power = 0.0;
  for (std::size_t e = 0; e < elements.tau.size(); ++e)
    if (mesh.is_owned[e])
      power += kernels::fluid_stabilisation_power(elements.geometry[e], state_of(state, mesh, e),
                                                  elements.coefficients, elements.tau[e]);
  return power;
}

}  // namespace tunica::assembly
