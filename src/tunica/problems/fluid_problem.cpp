#include "tunica/problems/fluid_problem.hpp"

#include <algorithm>
#include <cmath>

#include "tunica/assembly/gather.hpp"
#include "tunica/assembly/mass_norm.hpp"
#include "tunica/base/error.hpp"
#include "tunica/base/reduce.hpp"
#include "tunica/kernels/surface_tri3.hpp"
#include "tunica/problems/inverted_element.hpp"

namespace tunica::problems {

FluidProblem::FluidProblem(const Teuchos::ParameterList& list, const fields::FieldMesh& mesh)
    : FieldProblem(list, mesh), options_(fluid_options(list)), position_(mesh.x) {
  make_solver(list);
  for (auto* field : {&local_.u, &local_.u_old, &local_.w, &local_.f})
    field->assign(mesh.n_nodes(), Vec3{});
  elements_.coefficients = {options_.density, options_.viscosity, 0.0, options_.viscous_factor};
  elements_.geometry = assembly::geometry_of(mesh, mesh.x);
  set_constraints();
}

FluidProblem::~FluidProblem() = default;

void FluidProblem::set_constraints() {
  condition_of_surface_.assign(mesh_->surfaces.size(), nullptr);
  round_.resize(mesh_->surfaces.size());
  for (const FlowCondition& condition : options_.conditions) {
    const int surface = mesh_->surface_index(condition.surface);
    if (surface < 0) continue;  // the case was checked against the mesh
    condition_of_surface_[surface] = &condition;
    if (condition.is_parabolic) round_[surface] = surface_geometry(*mesh_, surface);
    if (condition.is_open()) continue;
    for (int a = 0; a < mesh_->n_nodes(); ++a)
      if (mesh_->is_on(a, surface)) fixed_[a] |= assembly::fixed_vector;
  }
  // Without an open surface the pressure is known up to a constant: pin it at one node.
  is_closed_ = open_surfaces().empty();
  if (is_closed_) {
    const int first = mesh_->ghosted_map->getLocalElement(0);
    if (first >= 0) fixed_[first] |= assembly::fixed_scalar;
  }
}

std::vector<int> FluidProblem::open_surfaces() const {
  std::vector<int> is_open(mesh_->surfaces.size(), 0), surfaces;
  for (const fields::Face& face : mesh_->faces) {
    const FlowCondition* condition = condition_of_surface_[face.surface];
    if (condition == nullptr || condition->is_open()) is_open[face.surface] = 1;
  }
  for (std::size_t s = 0; s < is_open.size(); ++s)
    if (global_max(*mesh_->comm, is_open[s]) == 1) surfaces.push_back(static_cast<int>(s));
  return surfaces;
}

void FluidProblem::begin_step(const stepping::Clock& clock) {
  time_ = clock.time();
  elements_.coefficients.inv_dt = 1.0 / clock.step_size();
  local_.u_old = fields::ghosted_vectors(*mesh_, x_[0]);
}

std::optional<std::string> FluidProblem::set_domain(const std::vector<Vec3>& d,
                                                    const std::vector<Vec3>& d_old) {
  for (int a = 0; a < mesh_->n_nodes(); ++a) {
    position_[a] = mesh_->x[a] + d[a];
    local_.w[a] = elements_.coefficients.inv_dt * (d[a] - d_old[a]);
  }
  elements_.geometry = assembly::geometry_of(*mesh_, position_);
  double smallest = 1.0;
  int worst = -1;
  for (std::size_t e = 0; e < elements_.geometry.size() && !std::isnan(smallest); ++e)
    if (worst < 0 || !(elements_.geometry[e].volume >= smallest)) {
      smallest = elements_.geometry[e].volume;
      worst = static_cast<int>(e);
    }
  return describe_inversion(*mesh_, smallest, worst, "volume in mm^3");
}

Vec3 FluidProblem::prescribed_velocity(int node, const FlowCondition& condition,
                                       int surface) const {
  if (condition.kind == "no slip") return {};
  if (condition.kind == "interface") return local_.w[node];
  if (boundary_velocity_) return boundary_velocity_(position_[node], time_);
  double factor = condition.amplitude(time_);
  if (condition.is_parabolic) {
    const double r = norm(position_[node] - round_[surface].centre) / round_[surface].radius;
    factor *= std::max(0.0, 1.0 - r * r);
  }
  return factor * condition.velocity;
}

void FluidProblem::impose_velocities() {
  // Where surfaces meet, the interface wins over no slip, and no slip over a velocity.
  const auto u = x_[0].getLocalViewHost(read_write);
  for (const std::string kind : {"velocity", "no slip", "interface"})
    for (std::size_t s = 0; s < condition_of_surface_.size(); ++s) {
      const FlowCondition* condition = condition_of_surface_[s];
      if (condition == nullptr || condition->kind != kind) continue;
      for (int a = 0; a < mesh_->n_owned; ++a) {
        if (!mesh_->is_on(a, static_cast<int>(s))) continue;
        const Vec3 value = prescribed_velocity(a, *condition, static_cast<int>(s));
        for (int i = 0; i < 3; ++i) u(3 * a + i, 0) = value[i];
      }
    }
}

double FluidProblem::outflow(const fields::Face& face, const std::vector<Vec3>& u) const {
  const auto v = assembly::gather(u, face.nodes);
  const Vec3 n = kernels::area_normal(assembly::gather(position_, face.nodes));
  return dot(n, v[0] + v[1] + v[2]) / 3.0;
}

void FluidProblem::check_closed_flow() const {
  const std::vector<Vec3> u = fields::ghosted_vectors(*mesh_, x_[0]);
  double net = 0.0, total = 0.0;
  for (const fields::Face& face : mesh_->faces) {
    if (!face.is_owned) continue;
    const double flux = outflow(face, u);
    net += flux;
    total += std::abs(flux);
  }
  net = global_sum(*mesh_->comm, net);
  total = global_sum(*mesh_->comm, total);
  // A velocity that conserves mass does so up to the interpolation on the surface only.
  TUNICA_CHECK(std::abs(net) <= 0.05 * total,
               "Fluid / Surfaces: " + std::to_string(-net) +
                   " mm^3/ms flow into a fluid that no surface lets out. Give one a traction or "
                   "a pressure, or leave it out of the list.");
}

void FluidProblem::prepare() {
  local_.p.resize(mesh_->n_nodes());
  impose_velocities();
  if (is_closed_) check_closed_flow();
  elements_.tau = assembly::fluid_taus(*mesh_, elements_, local_);
  if (body_force_)
    for (int a = 0; a < mesh_->n_nodes(); ++a) local_.f[a] = body_force_(position_[a], time_);
}

nonlinear::NewtonReport FluidProblem::solve() {
  prepare();
  return find_state();
}

void FluidProblem::set_initial_velocity(const std::function<Vec3(const Vec3& x)>& u) {
  std::vector<Vec3> values(mesh_->n_nodes());
  for (int a = 0; a < mesh_->n_nodes(); ++a) values[a] = u(mesh_->x[a]);
  fields::store(values, *mesh_, x_[0]);
}

Vec3 FluidProblem::traction_on(const std::array<Vec3, 3>& x, const FlowCondition& condition) const {
  Vec3 traction = condition.traction;
  if (condition.kind == "pressure") {
    const Vec3 n = kernels::area_normal(x);
    traction = -condition.pressure / norm(n) * n;
  }
  return condition.amplitude(time_) * traction;
}

void FluidProblem::add_surface_terms(assembly::BlockAssembler* K) {
  kernels::SurfaceResidual R;
  kernels::SurfaceJacobian J;
  for (const fields::Face& face : mesh_->faces) {
    const FlowCondition* condition = condition_of_surface_[face.surface];
    if (condition == nullptr || !condition->is_open()) continue;
    const std::array<Vec3, 3> x = assembly::gather(position_, face.nodes);
    R_.add(*mesh_, face, kernels::dead_traction(x, traction_on(x, *condition)));
    if (condition->backflow == 0.0) continue;
    const auto u = assembly::gather(local_.u, face.nodes),
               w = assembly::gather(local_.w, face.nodes);
    const double beta_rho = condition->backflow * options_.density;
    if (K == nullptr) {
      R = kernels::backflow(x, u, w, beta_rho);
    } else {
      kernels::backflow_jacobian(x, u, w, beta_rho, R, J);
      K->add(face, J);
    }
    R_.add(*mesh_, face, R);
  }
}

void FluidProblem::read(const algebra::BlockVector& x) {
  local_.u = fields::ghosted_vectors(*mesh_, x[0]);
  local_.p = fields::ghosted_scalars(*mesh_, x[1]);
}

void FluidProblem::assemble(assembly::BlockAssembler* K) {
  R_.set_zero();
  assembly::assemble_fluid(*mesh_, elements_, local_, R_, K);
  add_surface_terms(K);
}

std::vector<Vec3> FluidProblem::reaction() {
  read(x_);
  assemble(nullptr);
  std::vector<Vec3> force(R_.u);
  for (Vec3& f : force) f = -1.0 * f;
  return force;
}

}  // namespace tunica::problems
