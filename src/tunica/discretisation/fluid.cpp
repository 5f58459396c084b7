#include "tunica/discretisation/fluid.hpp"

#include <algorithm>
#include <cmath>

#include "tunica/assembly/gather.hpp"
#include "tunica/assembly/viscous_residual.hpp"
#include "tunica/base/error.hpp"
#include "tunica/base/reduce.hpp"
#include "tunica/boundary/surface_geometry.hpp"
#include "tunica/discretisation/inverted_element.hpp"
#include "tunica/kernels/surface_tri3.hpp"
#include "tunica/materials/viscosity_law.hpp"
#include "tunica/stepping/registry.hpp"

namespace tunica::discretisation {

Fluid::Fluid(const FluidOptions& options, const fields::FieldMesh& mesh)
    : MixedField(mesh, {{{"velocity", 3}, {"pressure", 1}},
                        options.conditions,
                        boundary::fluid_conditions(),
                        options.make_scheme()}),
      options_(options), position_(mesh.x) {
  for (auto* field : {&local_.u, &local_.u_old, &local_.w, &local_.f})
    field->assign(mesh.n_nodes(), Vec3{});
  local_.p.resize(mesh.n_nodes());
  elements_.coefficients.density = options_.density;
  elements_.coefficients.viscosity = options_.viscosity.get();
  elements_.coefficients.viscous_factor = options_.viscous_factor;
  elements_.coefficients.has_dynamic_subscales = options_.has_dynamic_subscales;
  elements_.coefficients.has_skew_convection = options_.has_skew_convection;
  elements_.coefficients.has_mean_residual = options_.has_mean_residual;
  if (options_.has_inertia_on_walls) mark_walls();
  // u' and q of the steps before stay with their elements: the scheme makes ũ' of the one and the
  // extrapolated force of the other.
  if (options_.has_dynamic_subscales)
    subscales_ = remember("subscales",
                          [this] { return assembly::fluid_subscales(*mesh_, elements_, local_); });
  if (options_.has_viscous_residual)
    viscous_ = remember("viscous force", [this] { return viscous_forces(); });
  elements_.geometry = assembly::ElementGeometry(mesh, position_);
  elements_.viscosity.assign(mesh.tets.size(), options_.viscosity->reference());
  find_open_surfaces();
  // Without an open surface the pressure is known up to a constant: pin it at the node with the
  // smallest vertex, the same on any ranks.
  is_closed_ = open_surfaces().empty();
  if (!is_closed_) return;
  double smallest = 1e300;
  for (const int vertex : mesh.vertex) smallest = std::min<double>(smallest, vertex);
  smallest = global_min(*mesh.comm, smallest);
  for (int a = 0; a < mesh.n_nodes(); ++a)
    if (mesh.vertex[a] == smallest) fixed_.fix_scalar(a);
}

Fluid::~Fluid() = default;

// Fluid passes a face where velocities along a part of its normal are free.
void Fluid::find_open_surfaces() {
  std::vector<double> passes(mesh_->surfaces.size(), 0.0);
  for (const fields::Face& face : mesh_->faces) {
    const Vec3 n = kernels::area_normal(assembly::gather(mesh_->x, face.nodes));
    const double least = surfaces_.has_held_directions(face.surface) ? boundary::flat : 1e-6;
    if (norm(surfaces_.free_part(face.surface, n)) > least * norm(n)) passes[face.surface] = 1.0;
  }
  for (const double found : global_sum(*mesh_->comm, passes)) is_open_.push_back(found > 0.0);
}

// ω_a = 1: the force on a wall has the inertia of the subscales beside it.
void Fluid::mark_walls() {
  local_.on_wall.assign(mesh_->n_nodes(), 0.0);
  for (const int s : walls())
    for (int a = 0; a < mesh_->n_nodes(); ++a)
      if (mesh_->is_on(a, s)) local_.on_wall[a] = 1.0;
}

std::vector<int> Fluid::walls() const {
  std::vector<int> surfaces;
  for (std::size_t s = 0; s < mesh_->surfaces.size(); ++s)
    if (surfaces_.sticks(static_cast<int>(s))) surfaces.push_back(static_cast<int>(s));
  return surfaces;
}

std::vector<int> Fluid::open_surfaces() const {
  std::vector<int> surfaces;
  for (std::size_t s = 0; s < is_open_.size(); ++s)
    if (is_open_[s]) surfaces.push_back(static_cast<int>(s));
  return surfaces;
}

std::vector<int> Fluid::staying_surfaces() const {
  std::vector<int> surfaces;
  for (std::size_t s = 0; s < mesh_->surfaces.size(); ++s)
    if (surfaces_.keeps_place(static_cast<int>(s))) surfaces.push_back(static_cast<int>(s));
  return surfaces;
}

// The first step has this velocity for its past, and the q that belongs to it.
void Fluid::start_from(const algebra::BlockVector& x) {
  read(x);
  timeline_.value() = fields::as_rows(local_.u);
  if (viscous_) viscous_->value() = fields::as_rows(viscous_forces());
}

constexpr const char* what_fixes = "prescribe() or fix_coefficients()";

// u̇ = (u − ũ)/Δt_e, ũ the past that the scheme makes of the steps before; τ takes the past, or the
// velocity that they predict.
void Fluid::begin_step(const stepping::Clock& clock) {
  time_ = scheme_->load_time(clock);
  scheme_->begin_step(clock);
  elements_.coefficients.inv_dt = scheme_->rate();
  local_.u_old = fields::as_vectors(scheme_->pasts(timeline_));
  if (options_.has_predicted_tau) predicted_ = fields::as_vectors(scheme_->predictions(timeline_));
  if (subscales_) local_.subscale = fields::as_vectors(scheme_->pasts(*subscales_));
  if (viscous_) local_.viscous = fields::as_vectors(scheme_->predictions(*viscous_));
  // μ(γ̇) in τ is that of the expected velocity too: τ is constant in a Newton solve.
  if (!options_.viscosity->is_constant())
    elements_.viscosity = assembly::fluid_viscosities(*mesh_, elements_, expected_velocity());
  surfaces_.begin_step();
  begin(what_fixes);
}

// x = X + d. The rate is that of the fluid's scheme, by which a uniform flow on a moving mesh stays
// uniform.
Outcome Fluid::set_domain(const std::vector<Vec3>& d, const std::vector<Vec3>& d_past) {
  wait_after_move_for(what_fixes);
  for (int a = 0; a < mesh_->n_nodes(); ++a) {
    position_[a] = mesh_->x[a] + d[a];
    local_.w[a] = scheme_->rate() * (d[a] - d_past[a]);  // w = (d − d̃)/Δt
  }
  return check_volumes(*mesh_, elements_.geometry);
}

boundary::Surroundings Fluid::surroundings() const {
  boundary::Surroundings here;
  here.mesh = mesh_;
  here.reference = &mesh_->x;
  here.position = &position_;
  here.u = &local_.u;
  here.w = &local_.w;
  here.time = time_;
  here.density = options_.density;
  here.viscosity = options_.viscosity->reference();
  here.mesh_rate = scheme_->rate();
  if (boundary_velocity_) here.velocity = &boundary_velocity_;
  return here;
}

// q = div 2μ ε(u), recovered at the vertices: a linear element has none of its own.
std::vector<Vec3> Fluid::viscous_forces() const {
  return assembly::viscous_forces(*mesh_, elements_.geometry, *options_.viscosity, local_.u);
}

// ∫ u·n da = A·(u_1 + u_2 + u_3)/3 with the area vector A, exact where u is linear
double Fluid::outflow(const fields::Face& face, const std::vector<Vec3>& u) const {
  const auto v = assembly::gather(u, face.nodes);
  const Vec3 n = kernels::area_normal(assembly::gather(position_, face.nodes));
  return dot(n, v[0] + v[1] + v[2]) / 3.0;
}

// |Σ_f ∫ u·n da| ≤ 10⁻³ Σ_f |∫ u·n da|: without an outlet div u = 0 has no solution otherwise.
void Fluid::check_closed_flow(const algebra::BlockVector& x) const {
  const std::vector<Vec3> u = fields::ghosted_vectors(*mesh_, x[0]);
  double net = 0.0, total = 0.0;
  for (const fields::Face& face : mesh_->faces) {
    if (!face.is_owned) continue;
    const double flux = outflow(face, u);
    net += flux;
    total += std::abs(flux);
  }
  net = global_sum(*mesh_->comm, net);
  total = global_sum(*mesh_->comm, total);
  // A velocity that conserves mass does so up to the interpolation on the surface only; what is
  // left vanishes in the pinned node.
  TUNICA_CHECK(std::abs(net) <= 1e-3 * total,
               "Fluid / Surfaces: " + std::to_string(-net) +
                   " mm^3/ms flow into a fluid without an open surface, of " +
                   std::to_string(total) +
                   " that pass its surfaces. Give one a traction or a pressure, omit it from the "
                   "list, or balance the velocities to 0.1 %.");
}

void Fluid::prescribe(algebra::BlockVector& x) {
  surfaces_.impose(surroundings(), x[0]);
  if (is_closed_) check_closed_flow(x);
  fix_coefficients();
}

// The rows of the interface become balances of momentum, to which the wall's are added. The wall
// takes up what flows in, and with its pressure that of the fluid is determined.
void Fluid::release_interface(const std::vector<Mat3>& free) {
  for (std::size_t s = 0; s < mesh_->surfaces.size(); ++s) {
    const int surface = static_cast<int>(s);
    if (!surfaces_.is_interface(surface)) continue;
    for (int a = 0; a < mesh_->n_nodes(); ++a)
      if (mesh_->is_on(a, surface)) fixed_.replace(a, free[a]);
  }
  if (is_closed_) fixed_.free_scalars();
  is_closed_ = false;
}

// τ = τ(u*, w) on the mesh as it lies, f at the places of its nodes
void Fluid::fix_coefficients() {
  wait_for(nullptr);
  elements_.tau = assembly::fluid_taus(*mesh_, elements_, expected_velocity(), local_.w);
  if (body_force_)
    for (int a = 0; a < mesh_->n_nodes(); ++a) local_.f[a] = body_force_(position_[a], time_);
}

// p ← p − ∫ p dV/∫ dV,   ∫ p dV = Σ_e V/4 Σ_a p_a
void Fluid::fix_pressure_level(algebra::BlockVector& x) const {
  if (!is_closed_) return;
  const std::vector<double> p = fields::ghosted_scalars(*mesh_, x[1]);
  double volume = 0.0, integral = 0.0;
  for (std::size_t e = 0; e < mesh_->tets.size(); ++e) {
    if (!mesh_->is_owned[e]) continue;
    const auto at = assembly::gather(p, mesh_->tets[e]);
    const double V = elements_.geometry[e].volume;
    volume += V;
    integral += 0.25 * V * (at[0] + at[1] + at[2] + at[3]);
  }
  const double mean = global_sum(*mesh_->comm, integral) / global_sum(*mesh_->comm, volume);
  const auto values = x[1].getLocalViewHost(read_write);
  for (std::size_t a = 0; a < values.extent(0); ++a) values(a, 0) -= mean;
}

void Fluid::read(const algebra::BlockVector& x) {
  local_.u = fields::ghosted_vectors(*mesh_, x[0]);
  local_.p = fields::ghosted_scalars(*mesh_, x[1]);
}

// S = ∂F/∂d_m: of the elements with what τ owes to h and c, then of the loads on open surfaces
void Fluid::assemble_shape_jacobian(const algebra::BlockVector& x) {
  read(x);
  if (!shape_)
    shape_ = std::make_unique<assembly::FluidShapeMatrix>(*mesh_, scalar_graph(), fixed_);
  shape_->begin(elements_, local_, expected_velocity());
  surfaces_.add_shape(surroundings(), *shape_);
  shape_->finish();
}

// R = Σ_e R_e(u, p) + what surfaces add,   K = ∂R/∂(u, p) at fixed τ and q
void Fluid::assemble(assembly::BlockAssembler* K) {
  R_.set_zero();
  assembly::assemble_fluid(*mesh_, elements_, local_, R_, K);
  surfaces_.add(surroundings(), R_, K);
}

// f = −R_u before prescribed rows are removed: with inertia, stabilisation and the surfaces' terms,
// so that the power of f on the wall is what the discrete fluid loses.
std::vector<Vec3> Fluid::reaction(const algebra::BlockVector& x) {
  read(x);
  assemble(nullptr);
  std::vector<Vec3> force(R_.u);
  for (Vec3& f : force) f = -1.0 * f;
  return force;
}

}  // namespace tunica::discretisation
