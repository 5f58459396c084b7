#include "tunica/discretisation/balance.hpp"

#include <algorithm>
#include <cmath>

#include "tunica/assembly/gather.hpp"
#include "tunica/discretisation/fluid.hpp"
#include "tunica/discretisation/solid.hpp"
#include "tunica/kernels/surface_tri3.hpp"

namespace tunica::discretisation {

// Tested with what is constant in space, the discrete equations are balances: all gradients of test
// functions vanish, those of SUPG and PSPG among them, and what Newton's method has left is all
// that they may miss. With R_u, R_p the residuals before prescribed rows are removed, P_a what is
// free at node a, Γ the interface, and ∂ the whole boundary
//
//   mass       −Σ_a R_p[a] = ∮_∂ u·n da                  of a wall: ∫ J − 1 + (p + p')/κ dV
//   momentum   Σ_a R_u[a] = I − L,   hence   I = L + A + B + D
//
//   I  inertia ∫ ρ (u̇ + (c·∇)u) dV, and that of tracked subscales on walls (kernels/fluid_up.cpp)
//   L  loads of the surfaces' terms
//   A  Σ_{a∉Γ} (1 − P_a) R_u[a]            B  Σ_{a∈Γ} R_u[a], of a wall the fluid's nodal force
//   D  Σ_{a∉Γ} P_a R_u[a], of a wall over all nodes: the error of the solver
//
// Tested with (u, −p), and a wall with its velocity, they are balances of energy. The power of A
// has in it the kinetic energy that enters where velocities are prescribed, as the convective form
// of the equations has it, and the power of what is left is
//
//   P_D = Σ_{a∉Γ} P_a R_u[a]·u_a − Σ_a R_p[a] p_a

namespace {

/// Of the owned nodes: rows of the residual, of the surfaces' terms alone, velocities, and which of
/// them lie on the interface.
struct Nodes {
  const assembly::Constraints& fixed;
  const std::vector<Vec3>&R, &of_surfaces, &velocity;
  const std::vector<char>& is_on_interface;
};

void add_nodes(const Nodes& nodes, Balance& b) {
  for (std::size_t a = 0; a < nodes.R.size(); ++a) {
    const Vec3 &R = nodes.R[a], &v = nodes.velocity[a], load = -1.0 * nodes.of_surfaces[a];
    b.loads += load;
    b.load_power += dot(load, v);
    b.forces += norm(load);
    if (nodes.is_on_interface[a] != 0) {
      b.interface += R;
      b.interface_power += dot(R, v);
      b.forces += norm(R);
      continue;
    }
    const Vec3 free = nodes.fixed.project(static_cast<int>(a), R), held = R - free;
    b.reactions += held;
    b.reaction_power += dot(held, v);
    b.forces += norm(held);
    b.error += free;
    b.power_error += dot(free, v);
    b.force_residual += norm(free);
  }
}

/// ∫ u (c·n) da on the triangle x, exact.
Vec3 carried_out(const std::array<Vec3, 3>& x, const std::array<Vec3, 3>& u,
                 const std::array<Vec3, 3>& w) {
  const Vec3 n = kernels::area_normal(x);
  Vec3 u_sum{}, carried{};
  double c_sum = 0.0;
  for (int a = 0; a < 3; ++a) {
    const double c = dot(u[a] - w[a], n);
    u_sum += u[a];
    c_sum += c;
    carried += c * u[a];
  }
  return 1.0 / 12.0 * (carried + c_sum * u_sum);
}

/// Of what flows along a surface, round-off makes less than this part pass it.
constexpr double closed = 1e-9;

// s = ± lg(1 + |J − 1|/ε), of which a bin is 1/64
constexpr double finest = 1e-6, bins_per_decade = 64.0;

double ratio_at(double bin) {
  const double s = (bin - 0.5 * volume_ratio_bins) / bins_per_decade;
  return 1.0 + std::copysign(finest * (std::pow(10.0, std::abs(s)) - 1.0), s);
}

}  // namespace

int bin_of_volume_ratio(double J) {
  const double s = std::copysign(std::log10(1.0 + std::abs(J - 1.0) / finest), J - 1.0);
  const double bin = std::floor(s * bins_per_decade + 0.5 * volume_ratio_bins);
  return static_cast<int>(std::min(std::max(bin, 0.0), volume_ratio_bins - 1.0));
}

double quantile_of_volume_ratio(const std::vector<double>& counts, double part) {
  double all = 0.0, below = 0.0;
  for (const double count : counts) all += count;
  for (std::size_t bin = 0; bin < counts.size(); ++bin) {
    if (counts[bin] > 0.0 && below + counts[bin] >= part * all)
      return ratio_at(static_cast<double>(bin) + (part * all - below) / counts[bin]);
    below += counts[bin];
  }
  return std::nan("");
}

Balance Fluid::balance(const algebra::BlockVector& x) {
  read(x);
  assemble(nullptr);
  assembly::NodalResidual of_surfaces(*mesh_);
  surfaces_.add(surroundings(), of_surfaces, nullptr);
  std::vector<char> is_on_interface(mesh_->n_owned);
  for (const fields::Face& face : mesh_->faces)
    for (const int a : face.nodes)
      if (a < mesh_->n_owned && surfaces_.is_interface(face.surface)) is_on_interface[a] = 1;
  Balance b;
  add_nodes({fixed_, R_.u, of_surfaces.u, local_.u, is_on_interface}, b);
  for (int a = 0; a < mesh_->n_owned; ++a) {
    b.power_error -= R_.p[a] * local_.p[a];
    if (!fixed_.is_scalar_fixed(a)) b.mass_residual += std::abs(R_.p[a]);
  }
  for (std::size_t e = 0; e < mesh_->tets.size(); ++e) {
    if (!mesh_->is_owned[e]) continue;
    const kernels::Tet4 T = elements_.geometry[e];
    const auto u = assembly::gather(local_.u, mesh_->tets[e]);
    b.volume += T.volume;
    b.momentum += 0.25 * options_.density * T.volume * (u[0] + u[1] + u[2] + u[3]);
  }
  add_faces(b);
  return b;
}

void Fluid::add_faces(Balance& b) const {
  for (const fields::Face& face : mesh_->faces) {
    if (!face.is_owned) continue;
    const auto x = assembly::gather(position_, face.nodes);
    const auto u = assembly::gather(local_.u, face.nodes);
    const auto w = assembly::gather(local_.w, face.nodes);
    const double flow = outflow(face, local_.u);
    const double along = norm(kernels::area_normal(x)) * norm(u[0] + u[1] + u[2]) / 3.0;
    b.net_outflow += flow;
    b.swept += outflow(face, local_.w);
    b.throughput += 0.5 * std::max(std::abs(flow), closed * along);
    b.outflow += options_.density * carried_out(x, u, w);
    if (!is_open_[face.surface] && !surfaces_.is_interface(face.surface))
      b.reaction_power -= options_.density * kernels::kinetic_outflow(x, u, w);
  }
}

// R_a ← R_a − ∫ ρ f N_a dV = R_a − ρ V/20 (f_a + Σ_b f_b)
void Solid::add_body_force(std::vector<Vec3>& rows) const {
  if (!body_force_) return;
  for (std::size_t e = 0; e < mesh_->tets.size(); ++e) {
    std::array<Vec3, 4> f;
    for (int i = 0; i < 4; ++i) f[i] = body_force_(mesh_->x[mesh_->tets[e][i]], time_);
    const double weight = 0.05 * elements_.layer(e).density * elements_.geometry[e].volume;
    for (int i = 0; i < 4; ++i)
      if (const int a = mesh_->tets[e][i]; a < mesh_->n_owned)
        rows[a] += -weight * (f[0] + f[1] + f[2] + f[3] + f[i]);
  }
}

// The fluid's force is one of the wall's nodal forces, so that no node of it is on an interface.
Balance Solid::balance(const algebra::BlockVector& x) {
  read(x);
  assemble(nullptr);
  assembly::NodalResidual of_surfaces(*mesh_, split());
  surfaces_.add(surroundings(), of_surfaces, nullptr);
  add_body_force(of_surfaces.u);
  Balance b;
  add_nodes({fixed_, R_.u, of_surfaces.u, v_, std::vector<char>(mesh_->n_owned)}, b);
  for (int a = 0; a < mesh_->n_owned; ++a) {
    b.interface += nodal_force_[a];
    b.interface_power += dot(nodal_force_[a], v_[a]);
    b.forces += norm(nodal_force_[a]);
  }
  for (const double R : R_.p) b.volume_error -= R;
  b.volume_ratios.resize(volume_ratio_bins);
  for (std::size_t e = 0; e < mesh_->tets.size(); ++e) {
    if (!mesh_->is_owned[e]) continue;
    const kernels::Tet4 T = elements_.geometry[e];
    const double J = kernels::solid_jacobian_determinant(
        T, elements_.displacement(e, assembly::gather(local_.d, mesh_->tets[e])));
    const auto v = assembly::gather(v_, mesh_->tets[e]);
    b.volume += T.volume * J;
    b.momentum += 0.25 * elements_.layer(e).density * T.volume * (v[0] + v[1] + v[2] + v[3]);
    if (is_nearly_incompressible(e)) b.volume_ratios[bin_of_volume_ratio(J)] += 1.0;
  }
  return b;
}

}  // namespace tunica::discretisation
