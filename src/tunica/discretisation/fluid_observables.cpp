#include <algorithm>
#include <cmath>

#include "tunica/assembly/gather.hpp"
#include "tunica/base/reduce.hpp"
#include "tunica/boundary/backflow.hpp"
#include "tunica/boundary/surface_geometry.hpp"
#include "tunica/boundary/surface_mass.hpp"
#include "tunica/boundary/traction.hpp"
#include "tunica/discretisation/fluid.hpp"
#include "tunica/kernels/energy.hpp"
#include "tunica/kernels/surface_tri3.hpp"
#include "tunica/kernels/viscosity.hpp"

namespace tunica::discretisation {

// The energies and powers of fluid and wall close the balance of a coupled run,
//
//   d/dt (K_f + K_w + E) = P_t + P_k + P_d − P_μ − P_β − P_τ − P_w
//
//   K_f  fluid_kinetic_energy  ½ρ ∫ |u|² dV      P_t  traction_power        ∫ t·u da
//   K_w  wall_kinetic_energy   ½ρ ∫ |v|² dV      P_k  kinetic_inflow        −½ρ ∫ |u|² c·n da
//   E    elastic_energy                          P_μ  viscous_power         ∫ 2μ ε:ε dV
//        + volumetric_energy                     P_β  backflow_power        −βρ ∫ (c·n)₋ |u|² da
//   c    u − w                                   P_τ  stabilisation_power   SUPG and PSPG
//   P_d  divergence_power      ½ρ ∫ |u|² div u dV; zero where convection is skew-symmetric
//                                                P_w  wall_stabilisation_power   PSPG of the wall
//
// up to what the time schemes take out, and the wall's stabilisation without inertia, which both
// vanish with Δt. P_τ does not vanish with Δt: smaller τ lets the pressure oscillate more at the
// moving wall
// ([BGL07]), see tests/verify/energy_balance.py. Surface integrals are over what the fluid may pass
// under a given traction, also where a windkessel gives it; the power of prescribed velocities, and
// of loads on the wall, is left out.

void Fluid::observe_volume(const assembly::FluidFields& state, Observables& found) const {
  const Comm& comm = *mesh_->comm;
  double volume = 0.0, kinetic = 0.0, viscous = 0.0, divergence = 0.0;
  for (std::size_t e = 0; e < mesh_->tets.size(); ++e) {
    if (!mesh_->is_owned[e]) continue;
    const kernels::Tet4 T = elements_.geometry[e];
    const auto u = assembly::gather(state.u, mesh_->tets[e]);
    volume += T.volume;
    kinetic += 0.5 * options_.density * kernels::squared_norm(T.volume, u);
    viscous += kernels::viscous_dissipation(T, u, *options_.viscosity);
    if (!options_.has_skew_convection)
      divergence += kernels::power_of_divergence(T, u, options_.density);
  }
  const double stabilisation = assembly::stabilisation_power(*mesh_, elements_, state);
  found.push_back({"fluid_volume_mm3", global_sum(comm, volume)});
  found.push_back({"fluid_kinetic_energy_kPa_mm3", global_sum(comm, kinetic)});
  found.push_back({"viscous_power_kPa_mm3_per_ms", global_sum(comm, viscous)});
  found.push_back({"stabilisation_power_kPa_mm3_per_ms", global_sum(comm, stabilisation)});
  found.push_back({"divergence_power_kPa_mm3_per_ms", global_sum(comm, divergence)});
}

void Fluid::observe_open_surfaces(const assembly::FluidFields& state, Observables& found) const {
  boundary::Surroundings here = surroundings();
  here.u = &state.u;
  std::map<std::string, double> sums{{boundary::traction_power, 0.0},
                                     {boundary::backflow_power, 0.0}};
  double inflow = 0.0;
  for (const fields::Face& face : mesh_->faces) {
    if (!face.is_owned || !is_open_[face.surface]) continue;
    inflow -= options_.density * kernels::kinetic_outflow(assembly::gather(position_, face.nodes),
                                                          assembly::gather(state.u, face.nodes),
                                                          assembly::gather(local_.w, face.nodes));
    surfaces_.observe(here, face, sums);
  }
  std::map<std::string, double> whole{{boundary::traction_power, 0.0}};
  surfaces_.observe_whole(here, whole);
  const auto total = [&](double mine) { return global_sum(*mesh_->comm, mine); };
  found.push_back({boundary::traction_power,
                   total(sums[boundary::traction_power]) + whole[boundary::traction_power]});
  found.push_back({"kinetic_inflow_kPa_mm3_per_ms", total(inflow)});
  found.push_back({boundary::backflow_power, total(sums[boundary::backflow_power])});
  whole.erase(boundary::traction_power);
  for (const auto& [name, value] : whole) found.push_back({name, value});
}

Observables Fluid::observe(const algebra::BlockVector& x) const {
  const Comm& comm = *mesh_->comm;
  assembly::FluidFields state = local_;
  state.u = fields::ghosted_vectors(*mesh_, x[0]);
  state.p = fields::ghosted_scalars(*mesh_, x[1]);
  Observables found;
  for (std::size_t s = 0; s < mesh_->surfaces.size(); ++s) {
    const int surface = static_cast<int>(s);
    if (!surfaces_.has_condition(surface) || surfaces_.sticks(surface)) continue;
    double inflow = 0.0;
    for (const fields::Face& face : mesh_->faces) {
      if (face.surface != surface || !face.is_owned) continue;
      inflow -= outflow(face, state.u);
    }
    found.push_back({"inflow_" + mesh_->surfaces[s] + "_mm3_per_ms", global_sum(comm, inflow)});
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
  observe_open_surfaces(state, found);
  return found;
}

// A surface takes from the fluid
//
//   F_p = ∫ p n da,   F_μ = F − F_p,   F = −∫ σ n da
//
//   p   nodal pressure      kPa      σ   stress of the fluid                      kPa
//   n   outward, unit        1       F   force of the fluid on what bounds it      mN
//
// Where the velocity is prescribed F is the sum of the nodal reactions, minus the momentum
// residual; elsewhere it is minus the load that the surface's terms put on the fluid, backflow
// stabilisation among them. The forces on all surfaces thus close the balance of momentum of the
// discrete flow. Where surfaces of prescribed velocity meet, the stress of the elements says how
// much of a reaction each takes, and what that leaves goes by area (boundary/surface_forces.hpp):
// exact for velocities and pressures that are linear in space.

boundary::NodalShares Fluid::tractions() const {
  boundary::NodalShares shares(*mesh_);
  for (const fields::Face& face : mesh_->faces) {
    const Vec3 n = kernels::area_normal(assembly::gather(position_, face.nodes));
    const auto p = assembly::gather(local_.p, face.nodes);
    const auto u = assembly::gather(local_.u, mesh_->tets[face.tet]);
    const kernels::Tet4 T = elements_.geometry[face.tet];
    const auto& grad_N = T.grad_N;
    const double mu = kernels::viscosity_at(*options_.viscosity, kernels::gradient(T, u)).value;
    Vec3 viscous{};  // −2μ ε n
    for (int a = 0; a < 4; ++a)
      viscous += -mu * (dot(grad_N[a], n) * u[a] + dot(u[a], n) * grad_N[a]);
    std::array<Vec3, 3> force;
    for (int a = 0; a < 3; ++a)  // ∫ N_a p n da + a third of the other
      force[a] = (p[0] + p[1] + p[2] + p[a]) / 12.0 * n + 1.0 / 3.0 * viscous;
    boundary::add_face(*mesh_, face, norm(n), force, shares);
  }
  return shares;
}

std::vector<Vec3> Fluid::forces(const algebra::BlockVector& x, const std::vector<int>& surfaces) {
  std::vector<Vec3> force(mesh_->surfaces.size());
  const auto has_reaction = [this](int s) { return !surfaces_.is_natural(s); };
  if (std::any_of(surfaces.begin(), surfaces.end(), has_reaction)) {
    // Before the first solve there are no stabilisation parameters and hence no residual.
    const Vec3 unknown{std::nan(""), std::nan(""), std::nan("")};
    const std::vector<Vec3> r =
        has_been_ready() ? reaction(x) : std::vector<Vec3>(mesh_->n_owned, unknown);
    force = boundary::reaction_forces(*mesh_, surfaces_, r, tractions());
  }
  for (const int s : surfaces) force[s] += -1.0 * surfaces_.load(surroundings(), s);
  return force;
}

// The wall takes from the fluid, node by node, the reaction of the momentum residual. Without what
// the pressure has of it that is the viscous force f, a linear density of which is
//
//   Σ_b ∫ N_a N_b da t_b = f_a,   τ = t − (t·n) n
//
//   f  viscous force of a node    mN      τ  wall shear stress      kPa
//   n  normal of the node's triangles, unit
//
// It varies less around a vessel than gradients of velocity in the elements, and its integral is
// the force.

std::vector<Vec3> Fluid::wall_shear_stress(const algebra::BlockVector& x) {
  const std::vector<int> walls = this->walls();
  if (walls.empty() || !has_been_ready()) return std::vector<Vec3>(mesh_->n_owned);
  const std::vector<Vec3> r = reaction(x);
  const std::vector<Vec3> taken = boundary::shared_reactions(*mesh_, surfaces_, r, tractions());
  const fields::NodeSurfaces& on = mesh_->node_surfaces;
  const auto is_wall = [&walls](int s) {
    return std::find(walls.begin(), walls.end(), s) != walls.end();
  };
  std::vector<Vec3> force(mesh_->n_owned);
  for (int a = 0; a < mesh_->n_owned; ++a)
    for (int k = on.begin(a); k < on.end(a); ++k)
      if (is_wall(on.surface(k))) force[a] += taken[k];
  for (const fields::Face& face : mesh_->faces) {
    if (!is_wall(face.surface)) continue;
    const Vec3 n = kernels::area_normal(assembly::gather(position_, face.nodes));
    const auto p = assembly::gather(local_.p, face.nodes);
    for (int a = 0; a < 3; ++a)  // − ∫ N_a p n da
      if (face.nodes[a] < mesh_->n_owned)
        force[face.nodes[a]] += -(p[0] + p[1] + p[2] + p[a]) / 12.0 * n;
  }
  std::vector<Vec3> stress = boundary::surface_density(*mesh_, position_, walls, force);
  const std::vector<Vec3> normal = boundary::nodal_areas(*mesh_, position_, walls);
  for (int a = 0; a < mesh_->n_owned; ++a)
    if (const double squared = dot(normal[a], normal[a]); squared > 0.0)
      stress[a] += -dot(stress[a], normal[a]) / squared * normal[a];
  return stress;
}

Fluid::SurfaceSums Fluid::sums_over(int surface) const {
  SurfaceSums sums{};
  for (const fields::Face& face : mesh_->faces) {
    if (face.surface != surface || !face.is_owned) continue;
    const Vec3 n = kernels::area_normal(assembly::gather(position_, face.nodes));
    const auto p = assembly::gather(local_.p, face.nodes);
    const double mean = (p[0] + p[1] + p[2]) / 3.0;
    sums.area += norm(n);
    sums.pressure += norm(n) * mean;
    sums.inflow -= outflow(face, local_.u);
    sums.pressure_force += mean * n;
  }
  return sums;
}

Observables Fluid::observe_surfaces(const algebra::BlockVector& x,
                                    const std::vector<int>& surfaces) {
  read(x);
  const std::vector<Vec3> force = forces(x, surfaces);
  std::vector<double> mine;
  for (const int s : surfaces) {
    const SurfaceSums sums = sums_over(s);
    mine.insert(mine.end(), {sums.area, sums.pressure, sums.inflow});
    mine.insert(mine.end(), sums.pressure_force.begin(), sums.pressure_force.end());
    mine.insert(mine.end(), force[s].begin(), force[s].end());
  }
  const std::vector<double> all = global_sum(*mesh_->comm, mine);
  Observables found;
  const double* sum = all.data();
  for (const int s : surfaces) {
    const std::string& name = mesh_->surfaces[s];
    const Vec3 of_pressure{sum[3], sum[4], sum[5]}, total{sum[6], sum[7], sum[8]};
    if (!surfaces_.has_condition(s)) found.push_back({"inflow_" + name + "_mm3_per_ms", sum[2]});
    found.push_back({"area_" + name + "_mm2", sum[0]});
    found.push_back({"mean_pressure_" + name + "_kPa", sum[1] / sum[0]});
    add_vector("pressure_force_" + name, "mN", of_pressure, found);
    add_vector("viscous_force_" + name, "mN", total - of_pressure, found);
    sum += 9;
  }
  return found;
}

}  // namespace tunica::discretisation
