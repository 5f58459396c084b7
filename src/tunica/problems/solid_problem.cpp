#include "tunica/problems/solid_problem.hpp"

#include <algorithm>
#include <cmath>

#include "tunica/assembly/gather.hpp"
#include "tunica/assembly/mass_norm.hpp"
#include "tunica/base/reduce.hpp"
#include "tunica/linear/direct_factor.hpp"
#include "tunica/materials/registry.hpp"
#include "tunica/problems/fibre_frames.hpp"
#include "tunica/problems/inverted_element.hpp"
#include "tunica/problems/layer_boundary.hpp"

namespace tunica::problems {

SolidProblem::SolidProblem(const Teuchos::ParameterList& list, const fields::FieldMesh& mesh)
    : FieldProblem(list, mesh), options_(solid_options(list)), d_old_(mesh.n_nodes()),
      v_old_(mesh.n_nodes()), a_old_(mesh.n_nodes()), nodal_force_(mesh.n_owned) {
  local_.r.assign(mesh.n_nodes(), Vec3{});
  make_solver(list);
  set_constraints();
  set_elements();
  set_layer_boundaries();
  set_frames(list.sublist("Fibre Frame"));
}

SolidProblem::~SolidProblem() = default;

void SolidProblem::set_constraints() {
  condition_of_surface_.assign(mesh_->surfaces.size(), nullptr);
  for (const WallCondition& condition : options_.conditions) {
    const int surface = mesh_->surface_index(condition.surface);
    if (surface < 0) continue;  // the case was checked against the mesh
    condition_of_surface_[surface] = &condition;
    for (int a = 0; a < mesh_->n_nodes(); ++a)
      if (mesh_->is_on(a, surface))
        for (const int i : condition.components) fixed_[a] |= std::uint8_t(1U << i);
  }
}

void SolidProblem::set_elements() {
  layer_of_region_.assign(mesh_->regions.size(), -1);
  for (std::size_t l = 0; l < options_.layers.size(); ++l) {
    const Layer& layer = options_.layers[l];
    laws_.push_back(materials::make_law(
        layer.law, materials::Constants(layer.constants.begin(), layer.constants.end())));
    const auto found = std::find(mesh_->regions.begin(), mesh_->regions.end(), layer.region);
    layer_of_region_[found - mesh_->regions.begin()] = static_cast<int>(l);
  }
  elements_.geometry = assembly::geometry_of(*mesh_, mesh_->x);
  for (const int region : mesh_->region) {
    elements_.law.push_back(laws_[layer_of_region_[region]].get());
    elements_.density.push_back(options_.layers[layer_of_region_[region]].density);
  }
  elements_.coefficients.resize(mesh_->tets.size());
}

void SolidProblem::set_layer_boundaries() {
  std::vector<int> material(mesh_->regions.size(), -1);
  for (std::size_t r = 0; r < material.size(); ++r)
    for (int l = layer_of_region_[r]; l >= 0; --l)
      if (options_.layers[l].has_material_of(options_.layers[layer_of_region_[r]])) material[r] = l;
  is_at_layer_ = at_layer_boundary(*mesh_, material);
}

void SolidProblem::set_frames(const Teuchos::ParameterList& list) {
  const auto has_fibres = [](const auto& law) { return law->has_fibres(); };
  if (std::any_of(laws_.begin(), laws_.end(), has_fibres))
    elements_.frames = fibre_frames(list, *mesh_);
}

double SolidProblem::alpha_of(const Layer& layer) const {
  if (options_.is_static) return 0.0;
  return stepping::Newmark{options_.beta, options_.gamma, dt_}.alpha(layer.density);
}

void SolidProblem::set_coefficients(double dt) {
  dt_ = dt;
  for (std::size_t e = 0; e < mesh_->tets.size(); ++e) {
    const Layer& layer = options_.layers[layer_of_region_[mesh_->region[e]]];
    const double h = kernels::element_length(elements_.geometry[e].volume);
    const double stiffness =
        4.0 * options_.modulus_factor * elements_.law[e]->stabilisation_modulus() / (h * h);
    const double alpha = alpha_of(layer);
    double tau = 1.0 / (stiffness + (options_.has_inertia_in_tau ? alpha : 0.0));
    // The pressure jumps between materials. PSPG takes the jump, spread over an element, for a
    // gradient out of balance and answers with a change of volume, see verify/test_inflation.cpp.
    if (is_at_layer_[e]) tau *= options_.layer_factor;
    elements_.coefficients[e] = {alpha, 1.0 / layer.bulk_modulus, tau};
  }
}

void SolidProblem::set_inertia_history() {
  const stepping::Newmark scheme{options_.beta, options_.gamma, dt_};
  for (int a = 0; a < mesh_->n_nodes(); ++a)
    local_.r[a] = options_.is_static ? Vec3{} : scheme.load(1.0, d_old_[a], v_old_[a], a_old_[a]);
}

void SolidProblem::add_body_force() {
  if (!body_force_) return;
  for (int a = 0; a < mesh_->n_nodes(); ++a) local_.r[a] += body_force_(mesh_->x[a], time_);
}

void SolidProblem::begin_step(const stepping::Clock& clock) {
  time_ = clock.time();
  if (dt_ != clock.step_size()) set_coefficients(clock.step_size());
  set_inertia_history();
  add_body_force();
}

nonlinear::NewtonReport SolidProblem::solve() { return find_state(); }

void SolidProblem::end_step() {
  const std::vector<Vec3> d = fields::ghosted_vectors(*mesh_, x_[0]);
  if (!options_.is_static) {
    const stepping::Newmark scheme{options_.beta, options_.gamma, dt_};
    for (int a = 0; a < mesh_->n_nodes(); ++a) {
      const Vec3 acceleration = scheme.acceleration(d[a], d_old_[a], v_old_[a], a_old_[a]);
      v_old_[a] = scheme.velocity(acceleration, v_old_[a], a_old_[a]);
      a_old_[a] = acceleration;
    }
  }
  d_old_ = d;
}

std::optional<std::vector<Vec3>> SolidProblem::respond(const stepping::Clock& clock,
                                                       const std::vector<Vec3>& force,
                                                       std::string& reason) {
  begin_step(clock);
  jacobian(x_);
  assembly::NodalResidual load(*mesh_);
  load.u = force;
  algebra::BlockVector b = fields::zero_vector(*mesh_), x = fields::zero_vector(*mesh_);
  load.store(*mesh_, fixed_, b);
  try {
    const linear::SolveReport report = linear_solver().solve(b, x, 1e-8);
    if (report.is_converged) return fields::owned_vectors(*mesh_, x[0]);
    reason = linear::describe_unconverged(report);
  } catch (const linear::SetupFailure& error) {
    reason = error.what();
  }
  return std::nullopt;
}

fields::State SolidProblem::save() const {
  fields::State state = FieldProblem::save();
  state.arrays["velocity"] = fields::rows_of(v_old_, mesh_->n_owned);
  state.arrays["acceleration"] = fields::rows_of(a_old_, mesh_->n_owned);
  return state;
}

std::string SolidProblem::restore(const fields::State& state) {
  v_old_ = fields::ghosted_rows(state.array("velocity", 3), *mesh_);
  a_old_ = fields::ghosted_rows(state.array("acceleration", 3), *mesh_);
  const std::string remark = FieldProblem::restore(state);
  d_old_ = fields::ghosted_vectors(*mesh_, x_[0]);
  return remark;
}

std::vector<Vec3> SolidProblem::displacement() const {
  return fields::owned_vectors(*mesh_, x_[0]);
}

std::vector<Vec3> SolidProblem::velocity() const {
  return {v_old_.begin(), v_old_.begin() + mesh_->n_owned};
}

void SolidProblem::add_surface_loads(const std::vector<Vec3>& d, assembly::BlockAssembler* K) {
  kernels::SurfaceResidual R;
  kernels::SurfaceJacobian J;
  for (const fields::Face& face : mesh_->faces) {
    const WallCondition* condition = condition_of_surface_[face.surface];
    if (condition == nullptr) continue;
    const double amplitude = condition->amplitude(time_);
    std::array<Vec3, 3> x = assembly::gather(mesh_->x, face.nodes);
    if (condition->kind == "traction") {
      R_.add(*mesh_, face, kernels::dead_traction(x, amplitude * condition->traction));
    } else if (condition->kind == "pressure") {
      for (int a = 0; a < 3; ++a) x[a] += d[face.nodes[a]];
      const double pressure = amplitude * condition->pressure;
      if (K == nullptr) {
        R = kernels::follower_pressure(x, pressure);
      } else {
        kernels::follower_pressure_jacobian(x, pressure, R, J);
        K->add(face, J);
      }
      R_.add(*mesh_, face, R);
    }
  }
}

void SolidProblem::read(const algebra::BlockVector& x) {
  local_.d = fields::ghosted_vectors(*mesh_, x[0]);
  local_.p = fields::ghosted_scalars(*mesh_, x[1]);
}

bool SolidProblem::is_admissible() {
  const auto worst = assembly::worst_solid_element(*mesh_, elements_, local_.d);
  const auto inversion = describe_inversion(*mesh_, worst.determinant, worst.element, "det F");
  refusal_ = inversion.value_or("");
  return !inversion;
}

void SolidProblem::assemble(assembly::BlockAssembler* K) {
  R_.set_zero();
  assembly::assemble_solid(*mesh_, elements_, local_, R_, K);
  add_surface_loads(local_.d, K);
  for (int a = 0; a < mesh_->n_owned; ++a) R_.u[a] += -1.0 * nodal_force_[a];
}

}  // namespace tunica::problems
