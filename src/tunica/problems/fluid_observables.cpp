#include <algorithm>

#include "tunica/assembly/gather.hpp"
#include "tunica/base/reduce.hpp"
#include "tunica/kernels/energy.hpp"
#include "tunica/kernels/surface_tri3.hpp"
#include "tunica/problems/fluid_problem.hpp"

namespace tunica::problems {

// The energies and powers of fluid and wall close the balance of a coupled run,
//
//   d/dt (K_f + K_w + E) = P_t + P_k − P_μ − P_β − P_τ
//
//   K_f  fluid_kinetic_energy  ½ρ ∫ |u|² dV      P_t  traction_power        ∫ t·u da
//   K_w  wall_kinetic_energy   ½ρ ∫ |v|² dV      P_k  kinetic_inflow        −½ρ ∫ |u|² c·n da
//   E    elastic_energy                          P_μ  viscous_power         ∫ 2μ ε:ε dV
//        + volumetric_energy                     P_β  backflow_power        −βρ ∫ (c·n)₋ |u|² da
//   c    u − w                                   P_τ  stabilisation_power   SUPG and PSPG
//
// up to what the time schemes and the wall's stabilisation take out, which vanish with Δt.
// P_τ does not vanish with Δt: smaller τ lets the pressure oscillate more at the moving wall
// ([BGL07]), see tests/verify/energy_balance.py. Surface integrals are over what the fluid may pass
// under a given traction; the power of prescribed velocities, and of loads on the wall, is left
// out.

void FluidProblem::observe_volume(const assembly::FluidFields& state, Observables& found) const {
  const Comm& comm = *mesh_->comm;
  double volume = 0.0, kinetic = 0.0, viscous = 0.0;
  for (std::size_t e = 0; e < mesh_->tets.size(); ++e) {
    if (!mesh_->is_owned[e]) continue;
    const kernels::Tet4& T = elements_.geometry[e];
    const auto u = assembly::gather(state.u, mesh_->tets[e]);
    volume += T.volume;
    kinetic += 0.5 * options_.density * kernels::squared_norm(T.volume, u);
    viscous += kernels::viscous_dissipation(T, u, options_.viscosity);
  }
  const double stabilisation = assembly::stabilisation_power(*mesh_, elements_, state);
  found.push_back({"fluid_volume_mm3", global_sum(comm, volume)});
  found.push_back({"fluid_kinetic_energy_kPa_mm3", global_sum(comm, kinetic)});
  found.push_back({"viscous_power_kPa_mm3_per_ms", global_sum(comm, viscous)});
  found.push_back({"stabilisation_power_kPa_mm3_per_ms", global_sum(comm, stabilisation)});
}

void FluidProblem::observe_open_surfaces(const std::vector<Vec3>& u, Observables& found) const {
  const Comm& comm = *mesh_->comm;
  double traction = 0.0, inflow = 0.0, backflow = 0.0;
  for (const fields::Face& face : mesh_->faces) {
    const FlowCondition* condition = condition_of_surface_[face.surface];
    if (!face.is_owned || (condition != nullptr && !condition->is_open())) continue;
    const auto x = assembly::gather(position_, face.nodes), v = assembly::gather(u, face.nodes),
               w = assembly::gather(local_.w, face.nodes);
    inflow -= options_.density * kernels::kinetic_outflow(x, v, w);
    if (condition == nullptr) continue;
    const auto load = kernels::dead_traction(x, traction_on(x, *condition)),
               brake = kernels::backflow(x, v, w, condition->backflow * options_.density);
    for (int a = 0; a < 3; ++a) {
      traction -= dot(load.u[a], v[a]);
      backflow += dot(brake.u[a], v[a]);
    }
  }
  found.push_back({"traction_power_kPa_mm3_per_ms", global_sum(comm, traction)});
  found.push_back({"kinetic_inflow_kPa_mm3_per_ms", global_sum(comm, inflow)});
  found.push_back({"backflow_power_kPa_mm3_per_ms", global_sum(comm, backflow)});
}

Observables FluidProblem::observe() const {
  const Comm& comm = *mesh_->comm;
  assembly::FluidFields state = local_;
  state.u = fields::ghosted_vectors(*mesh_, x_[0]);
  state.p = fields::ghosted_scalars(*mesh_, x_[1]);
  Observables found;
  for (std::size_t s = 0; s < condition_of_surface_.size(); ++s) {
    const FlowCondition* condition = condition_of_surface_[s];
    if (condition == nullptr || condition->kind == "interface" || condition->kind == "no slip")
      continue;
    double inflow = 0.0;
    for (const fields::Face& face : mesh_->faces) {
      if (face.surface != static_cast<int>(s) || !face.is_owned) continue;
      inflow -= outflow(face, state.u);
    }
    found.push_back({"inflow_" + condition->surface + "_mm3_per_ms", global_sum(comm, inflow)});
  }
  double low = 1e300, high = -1e300, speed = 0.0;
  for (int a = 0; a < mesh_->n_owned; ++a) {
    low = std::min(low, state.p[a]);
    high = std::max(high, state.p[a]);
    speed = std::max(speed, norm(state.u[a]));
  }
  found.push_back({"fluid_pressure_min_kPa", global_min(comm, low)});
  found.push_back({"fluid_pressure_max_kPa", global_max(comm, high)});
  found.push_back({"max_speed_mm_per_ms", global_max(comm, speed)});
  observe_volume(state, found);
  observe_open_surfaces(state.u, found);
  return found;
}

}  // namespace tunica::problems
