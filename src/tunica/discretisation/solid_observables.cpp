#include <algorithm>

#include "tunica/assembly/gather.hpp"
#include "tunica/base/reduce.hpp"
#include "tunica/boundary/surface_forces.hpp"
#include "tunica/discretisation/solid.hpp"
#include "tunica/kernels/deformation.hpp"
#include "tunica/kernels/energy.hpp"
#include "tunica/kernels/surface_tri3.hpp"

namespace tunica::discretisation {

/// Extremes and sums on one rank.
struct Solid::Summary {
  double displacement = 0.0, interface_displacement = 0.0;
  double low_pressure = 1e300, high_pressure = -1e300;
  double low_J = 1e300, high_J = -1e300;
  double elastic = 0.0, volumetric = 0.0, kinetic = 0.0, stabilisation = 0.0;
};

Observables Solid::observables_of(const Summary& s, const Comm& comm, bool has_interface) {
  Observables found{{"max_displacement_wall_mm", global_max(comm, s.displacement)},
                    {"min_det_F", global_min(comm, s.low_J)},
                    {"max_det_F", global_max(comm, s.high_J)},
                    {"wall_pressure_min_kPa", global_min(comm, s.low_pressure)},
                    {"wall_pressure_max_kPa", global_max(comm, s.high_pressure)},
                    {"elastic_energy_kPa_mm3", global_sum(comm, s.elastic)},
                    {"volumetric_energy_kPa_mm3", global_sum(comm, s.volumetric)},
                    {"wall_kinetic_energy_kPa_mm3", global_sum(comm, s.kinetic)},
                    {"wall_stabilisation_power_kPa_mm3_per_ms", global_sum(comm, s.stabilisation)}};
  if (has_interface)
    found.insert(found.begin() + 1,
                 {"max_displacement_interface_mm", global_max(comm, s.interface_displacement)});
  return found;
}

// For the balance that the energies close see fluid_observables.cpp. The elastic energy is that
// of the isochoric law, the volumetric one ∫ p²/(2κ) dV; the velocity is that of the last
// accepted step. What PSPG takes out moves the subscales and swings there; without inertia of
// theirs it vanishes with Δt and is not counted.

Observables Solid::observe(const algebra::BlockVector& x) const {
  const std::vector<Vec3> d = fields::ghosted_vectors(*mesh_, x[0]);
  const std::vector<double> p = fields::ghosted_scalars(scalar_mesh(), x[1]);
  std::vector<int> interfaces;
  for (int k = 0; k < static_cast<int>(mesh_->surfaces.size()); ++k)
    if (surfaces_.is_interface(k)) interfaces.push_back(k);
  Summary s;
  for (int a = 0; a < mesh_->n_owned; ++a) {
    s.displacement = std::max(s.displacement, norm(d[a]));
    if (mesh_->is_on_any(a, interfaces))
      s.interface_displacement = std::max(s.interface_displacement, norm(d[a]));
  }
  for (int a = 0; a < scalar_mesh().n_owned; ++a) {
    s.low_pressure = std::min(s.low_pressure, p[a]);
    s.high_pressure = std::max(s.high_pressure, p[a]);
  }
  const std::vector<Vec3> v = velocity();
  for (std::size_t e = 0; e < mesh_->tets.size(); ++e)
    add_element(e, assembly::gather(d, mesh_->tets[e]), assembly::gather(v, mesh_->tets[e]),
                assembly::gather(p, scalar_mesh().tets[e]), s);
  Observables found = observables_of(s, *mesh_->comm, !interfaces.empty());
  boundary::Surroundings here = surroundings();
  here.u = &d;
  here.w = &v;
  std::map<std::string, double> of_surfaces;
  surfaces_.observe_whole(here, of_surfaces);
  for (const auto& [name, value] : of_surfaces) found.push_back({name, value});
  return found;
}

// Extremes may count an element on several ranks, sums only on the one that owns it.
void Solid::add_element(std::size_t e, const std::array<Vec3, 4>& d, const std::array<Vec3, 4>& v,
                        const std::array<double, 4>& p, Summary& s) const {
  const auto de = elements_.displacement(e, d);
  const kernels::Tet4 T = elements_.geometry[e];
  const double J = kernels::solid_jacobian_determinant(T, de);
  s.low_J = std::min(s.low_J, J);
  s.high_J = std::max(s.high_J, J);
  if (!mesh_->is_owned[e]) return;
  const double V = T.volume;
  const Sym3 C = kernels::right_cauchy_green(kernels::deformation_gradient(T, de));
  const assembly::SolidLayer& layer = elements_.layer(e);
  s.elastic += V * layer.law->energy(C, elements_.frame(e), elements_.past_of(e));
  s.volumetric += 0.5 * layer.coefficients.inv_kappa * kernels::squared_norm(V, p);
  s.kinetic += 0.5 * layer.density * kernels::squared_norm(V, v);
  if (subscales_ && is_nearly_incompressible(e)) {
    const stepping::Rows& rate = (*subscales_)[0];
    s.stabilisation +=
        kernels::subscale_power(T, de, p, {rate[3 * e], rate[3 * e + 1], rate[3 * e + 2]});
  }
}

// A surface that holds the wall takes from it the sum of the nodal reactions, minus the momentum
// residual, inertia and the loads on the other surfaces included. Where such surfaces meet they
// share it by their undeformed areas (boundary/surface_forces.hpp).

std::vector<Vec3> Solid::reaction_forces(const algebra::BlockVector& x) {
  read(x);
  assemble(nullptr);
  std::vector<Vec3> reaction(R_.u);
  for (Vec3& r : reaction) r = -1.0 * r;
  boundary::NodalShares shares(*mesh_);
  for (const fields::Face& face : mesh_->faces) {
    const Vec3 n = kernels::area_normal(assembly::gather(mesh_->x, face.nodes));
    boundary::add_face(*mesh_, face, norm(n), {}, shares);
  }
  return boundary::reaction_forces(*mesh_, surfaces_, reaction, shares);
}

// A₀, ∫ d dA₀ = Σ_f A₀/3 (d_1 + d_2 + d_3), and the area of x + d
Solid::SurfaceSums Solid::sums_over(int surface, const std::vector<Vec3>& d) const {
  SurfaceSums sums{};
  for (const fields::Face& face : mesh_->faces) {
    if (face.surface != surface || !face.is_owned) continue;
    auto x = assembly::gather(mesh_->x, face.nodes);
    const auto moves = assembly::gather(d, face.nodes);
    const double A = norm(kernels::area_normal(x));
    sums.undeformed_area += A;
    sums.displacement += A / 3.0 * (moves[0] + moves[1] + moves[2]);
    for (int a = 0; a < 3; ++a) x[a] += moves[a];
    sums.area += norm(kernels::area_normal(x));
  }
  return sums;
}

Observables Solid::observe_surfaces(const algebra::BlockVector& x,
                                    const std::vector<int>& surfaces) {
  const auto holds = [this](int s) { return !surfaces_.is_natural(s); };
  const auto is_clamped = [this](int s) {
    return surfaces_.prescribes(s, 0) && surfaces_.prescribes(s, 1) && surfaces_.prescribes(s, 2) &&
           !surfaces_.moves_as_one(s);
  };
  std::vector<Vec3> force(mesh_->surfaces.size());
  if (std::any_of(surfaces.begin(), surfaces.end(), holds)) force = reaction_forces(x);
  const std::vector<Vec3> d = fields::ghosted_vectors(*mesh_, x[0]);
  std::vector<double> mine;
  for (const int s : surfaces) {
    const SurfaceSums sums = sums_over(s, d);
    mine.insert(mine.end(), {sums.area, sums.undeformed_area});
    mine.insert(mine.end(), sums.displacement.begin(), sums.displacement.end());
    mine.insert(mine.end(), force[s].begin(), force[s].end());
  }
  const std::vector<double> all = global_sum(*mesh_->comm, mine);
  Observables found;
  const double* sum = all.data();
  for (const int s : surfaces) {
    const std::string& name = mesh_->surfaces[s];
    const Vec3 moved = 1.0 / sum[1] * Vec3{sum[2], sum[3], sum[4]};
    found.push_back({"wall_area_" + name + "_mm2", sum[0]});
    if (!is_clamped(s)) add_vector("mean_displacement_" + name, "mm", moved, found);
    if (holds(s)) add_vector("wall_force_" + name, "mN", {sum[5], sum[6], sum[7]}, found);
    sum += 8;
  }
  return found;
}

}  // namespace tunica::discretisation
