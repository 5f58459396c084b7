#include "tunica/discretisation/solid.hpp"

#include <algorithm>

#include "tunica/assembly/gather.hpp"
#include "tunica/assembly/stress_residual.hpp"
#include "tunica/base/error.hpp"
#include "tunica/base/reduce.hpp"
#include "tunica/discretisation/inverted_element.hpp"
#include "tunica/discretisation/layer_boundary.hpp"
#include "tunica/kernels/deformation.hpp"
#include "tunica/stepping/registry.hpp"

namespace tunica::discretisation {

namespace {

/// Null where no pressure jumps.
std::unique_ptr<fields::SplitMesh> mesh_of_pressures(const SolidOptions& options,
                                                     const fields::FieldMesh& mesh) {
  if (!options.has_doubled_pressure) return nullptr;
  return fields::split_mesh(mesh, material_of_regions(options.layers, mesh));
}

}  // namespace

Solid::Solid(const SolidOptions& options, const fields::FieldMesh& mesh,
             std::vector<materials::Frame> frames)
    : MixedField(mesh, {{{"displacement", 3}, {"pressure", 1}},
                        options.conditions,
                        boundary::wall_conditions(),
                        options.make_scheme(),
                        mesh_of_pressures(options, mesh),
                        true}),
      options_(options), prestretch_(mesh, [this] { follow_prestretch(); }),
      nodal_force_(mesh.n_owned) {
  if (norm(options_.body_force) > 0.0)
    body_force_ = [f = options_.body_force](const Vec3&, double) { return f; };
  local_.r.assign(mesh.n_nodes(), Vec3{});
  local_.d.resize(mesh.n_nodes());
  past_.resize(mesh.n_nodes());
  v_.resize(mesh.n_nodes());
  local_.p.resize(scalar_mesh().n_nodes());
  set_elements();
  if (!options_.has_doubled_pressure)
    is_at_layer_ = at_layer_boundary(mesh, material_of_regions(options_.layers, mesh));
  if (options_.has_dynamic_subscales)
    subscales_ = remember("subscales",
                          [this] { return assembly::solid_subscales(*mesh_, elements_, local_); });
  // One width for all rows: the longest memory of any layer.
  for (const auto& law : laws_)
    elements_.past_width = std::max(elements_.past_width, law->state_width());
  if (elements_.past_width > 0)
    of_laws_ = remember("laws", {fields::Places::elements(mesh), elements_.past_width},
                        [this](stepping::Timeline& past) {
                          past.push(assembly::remembered_by_laws(*mesh_, elements_, local_.d));
                        });
  begin_laws(0.0);
  if (options_.has_stress_residual)
    patches_ = std::make_unique<assembly::PatchRecovery>(scalar_mesh());
  elements_.frames = frames;
  frames_ = std::move(frames);
}

Solid::~Solid() = default;

void Solid::set_elements() {
  std::vector<std::int16_t> layer_of_region(mesh_->regions.size(), -1);
  for (std::size_t l = 0; l < options_.layers.size(); ++l) {
    const Layer& layer = options_.layers[l];
    laws_.push_back(law_of(layer));
    elements_.layers.push_back({laws_.back().get(), layer.density});
    const auto found = std::find(mesh_->regions.begin(), mesh_->regions.end(), layer.region);
    layer_of_region[found - mesh_->regions.begin()] = static_cast<std::int16_t>(l);
  }
  elements_.geometry = assembly::ElementGeometry(*mesh_, mesh_->x, prestretch_.values());
  elements_.layer_number.reserve(mesh_->tets.size());
  for (const int region : mesh_->region) elements_.layer_number.push_back(layer_of_region[region]);
  elements_.tau.resize(mesh_->tets.size());
  elements_.split = split();
}

// All det G > 0, or the old prestretch stays as it is.
Outcome Solid::set_prestretch(std::vector<Mat3> G) {
  double smallest = 1.0;
  int worst = -1;
  for (std::size_t e = 0; e < G.size(); ++e) {
    const double J = det(G[e]);
    if (worst >= 0 && J >= smallest) continue;
    smallest = J;
    worst = static_cast<int>(e);
    if (std::isnan(J)) break;
  }
  const Outcome outcome = check_inversion(*mesh_, smallest, worst, "det G");
  if (outcome.is_failure()) return outcome.at("the wall where it is free of stress");
  prestretch_.set(std::move(G));
  follow_prestretch();
  return Outcome::success();
}

// Fibres are lines of material with given directions a in the mesh; without stress they lie along
// G⁻¹a.
void Solid::follow_prestretch() {
  for (std::size_t e = 0; e < frames_.size(); ++e)
    elements_.frames[e] = prestretch_.values().empty()
                              ? frames_[e]
                              : materials::pulled_back(frames_[e], prestretch_.values()[e]);
  unit_inertia_ = -1.0;  // stabilisation follows the size of elements
}

// α, 1/κ and τ_v = c μ_l of each layer;   1/τ = 4 m μ_l/h² + α of each element
void Solid::set_coefficients() {
  for (std::size_t l = 0; l < options_.layers.size(); ++l) {
    const double modulus = laws_[l]->stabilisation_modulus();
    elements_.layers[l].coefficients = {scheme_->inertia(options_.layers[l].density),
                                        1.0 / options_.layers[l].bulk_modulus, 0.0,
                                        options_.volumetric_factor * modulus};
  }
  for (std::size_t e = 0; e < mesh_->tets.size(); ++e) {
    const assembly::SolidLayer& layer = elements_.layer(e);
    const double h = kernels::element_length(elements_.geometry[e].volume);
    const double modulus = layer.law->stabilisation_modulus();
    const double stiffness = 4.0 * options_.modulus_factor * modulus / (h * h);
    const double alpha = layer.coefficients.alpha;
    double tau = 1.0 / (stiffness + (options_.has_inertia_in_tau ? alpha : 0.0));
    // The pressure jumps between materials. Where it is continuous, PSPG takes the jump, spread
    // over an element, for a gradient out of balance and answers with a change of volume, see
    // verify/test_inflation.cpp.
    if (!is_at_layer_.empty() && is_at_layer_[e]) tau *= options_.layer_factor;
    elements_.tau[e] = tau;
  }
}

// Where a wall is compressible its pressure needs no stabilisation, and waves of it resonate with
// subscales that swing on their own: a wall with κ = 3 μ_l, left to itself, gains energy without
// bound; with 8 μ_l it keeps it, see verify/test_wall_energy.cpp.
bool Solid::is_nearly_incompressible(std::size_t element) const {
  const assembly::SolidLayer& layer = elements_.layer(element);
  return 1.0 >= 20.0 * layer.coefficients.inv_kappa * layer.law->stabilisation_modulus();
}

// r and r' of the scheme for unit density, and f beside r: the kernel's histories are ρ r, ρ r'.
void Solid::set_inertia_loads() {
  local_.r = fields::as_vectors(scheme_->inertia_loads(timeline_));
  if (body_force_)
    for (int a = 0; a < mesh_->n_nodes(); ++a) local_.r[a] += body_force_(mesh_->x[a], time_);
  if (!subscales_) return;
  local_.subscale_r = fields::as_vectors(scheme_->inertia_loads(*subscales_));
  for (std::size_t e = 0; e < mesh_->tets.size(); ++e)
    if (!is_nearly_incompressible(e)) local_.subscale_r[e] = Vec3{};
}

void Solid::begin_step(const stepping::Clock& clock) {
  time_ = scheme_->load_time(clock);
  scheme_->begin_step(clock);
  // α and τ stay as long as Δt does.
  if (unit_inertia_ != scheme_->inertia(1.0)) {
    unit_inertia_ = scheme_->inertia(1.0);
    set_coefficients();
  }
  begin_laws(options_.is_static ? 0.0 : clock.step_size());
  set_inertia_loads();
  past_ = fields::as_vectors(scheme_->pasts(timeline_));
  // σ'* of the displacement with which the step begins: constant in it, Jacobians are exact.
  if (patches_) local_.stress_force = stress_force_at(fields::as_vectors(timeline_.value()));
  stress_change_.clear();
  stress_relaxation_ = 1.0;
  surfaces_.begin_step();
  begin(nullptr);
}

// With Δt = 0 laws are in equilibrium: what relaxes has done so.
void Solid::begin_laws(double step) {
  if (!of_laws_) return;
  elements_.past = of_laws_->value();
  elements_.step = step;
}

void Solid::start_from(const algebra::BlockVector& x, const std::vector<Vec3>& velocity) {
  read(x);
  timeline_.value() = fields::as_rows(local_.d);
  const std::vector<std::string>& names = timeline_.names();
  if (!names.empty() && names.front() == "velocity") timeline_[0] = fields::as_rows(velocity);
  settle(x);
}

void Solid::settle(const algebra::BlockVector& x) {
  if (!of_laws_) return;
  read(x);
  elements_.step = 0.0;
  of_laws_->push(assembly::remembered_by_laws(*mesh_, elements_, local_.d));
}

// Where a wall is as soft by volume as by shape its pressure needs no stabilisation, and this one
// feeds on itself: a block of κ = 1.1 μ_l made of it nine times as much from pass to pass. With
// κ = 3 μ_l it lessens errors, see verify/test_manufactured_wall.cpp.
std::vector<Vec3> Solid::stress_force_at(const std::vector<Vec3>& d) const {
  std::vector<Vec3> force = assembly::stress_forces(*patches_, *mesh_, elements_, d);
  for (std::size_t e = 0; e < force.size(); ++e) {
    const assembly::SolidLayer& layer = elements_.layer(e);
    if (2.0 * layer.coefficients.inv_kappa * layer.law->stabilisation_modulus() > 1.0)
      force[e] = Vec3{};
  }
  return force;
}

bool Solid::leave_out_stress_force() {
  const bool has_any = product_over_elements(local_.stress_force, local_.stress_force) > 0.0;
  std::fill(local_.stress_force.begin(), local_.stress_force.end(), Vec3{});
  return has_any;
}

// s ← s + ω r,   r = σ'*(x) − s,   ω ← −ω ⟨r⁻, r − r⁻⟩ / |r − r⁻|²
double Solid::renew_stress_force(const algebra::BlockVector& x) {
  const std::vector<Vec3> found = stress_force_at(fields::ghosted_vectors(*mesh_, x[0]));
  std::vector<Vec3> change(found.size());
  for (std::size_t e = 0; e < found.size(); ++e) change[e] = found[e] - local_.stress_force[e];
  const double squared_change = product_over_elements(change, change);
  if (!stress_change_.empty()) {
    std::vector<Vec3> difference(found.size());
    for (std::size_t e = 0; e < found.size(); ++e) difference[e] = change[e] - stress_change_[e];
    const double squared = product_over_elements(difference, difference);
    if (squared > 0.0)
      stress_relaxation_ *= -product_over_elements(stress_change_, difference) / squared;
    // Within bounds: two changes that hardly differ make ω any number.
    stress_relaxation_ = std::min(std::max(stress_relaxation_, 0.5), 3.0);
  }
  for (std::size_t e = 0; e < found.size(); ++e)
    local_.stress_force[e] += stress_relaxation_ * change[e];
  stress_change_ = std::move(change);
  // |σ'*(x) − s| / |σ'*(x)|, before s has moved
  const double size = product_over_elements(found, found);
  return size > 0.0 ? std::sqrt(squared_change / size) : 0.0;
}

// ⟨a, b⟩ = ∫ a·b dV over owned elements of all ranks
double Solid::product_over_elements(const std::vector<Vec3>& a, const std::vector<Vec3>& b) const {
  double sum = 0.0;
  for (std::size_t e = 0; e < a.size(); ++e)
    if (mesh_->is_owned[e]) sum += elements_.geometry[e].volume * dot(a[e], b[e]);
  return global_sum(*mesh_->comm, sum);
}

// A continuous pressure makes one part of all materials; −1 outside the wall stays.
std::vector<int> Solid::pressure_parts() const {
  std::vector<int> parts = material_of_regions(options_.layers, *mesh_);
  if (!options_.has_doubled_pressure)
    for (int& part : parts) part = std::min(part, 0);
  return parts;
}

void Solid::load_of(const std::vector<Vec3>& force, algebra::BlockVector& b) const {
  assembly::NodalResidual load(*mesh_, split());
  load.u = force;
  load.store(fixed_, b);
}

void Solid::read(const algebra::BlockVector& x) {
  local_.d = fields::ghosted_vectors(*mesh_, x[0]);
  for (std::size_t a = 0; a < v_.size(); ++a)
    v_[a] = scheme_->rate() * (local_.d[a] - past_[a]);  // v = (d − d̃)/Δt
  local_.p = fields::ghosted_scalars(scalar_mesh(), x[1]);
}

boundary::Surroundings Solid::surroundings() const {
  boundary::Surroundings here;
  here.mesh = mesh_;
  here.reference = here.position = &mesh_->x;  // loads are in the undeformed wall
  here.u = &local_.d;
  here.w = &v_;
  here.time = time_;
  if (!spring_offset_.empty()) here.spring_offset = &spring_offset_;
  here.follows = !stays_on_mesh_;
  return here;
}

// min_e det F > 0
Outcome Solid::is_admissible() const {
  const auto worst = assembly::worst_solid_element(*mesh_, elements_, local_.d);
  return check_inversion(*mesh_, worst.determinant, worst.element, "det F");
}

constexpr const char* prestress_name = "prestress";
constexpr const char* offset_name = "spring offset";

void Solid::save_history(fields::State& state) const {
  MixedField::save_history(state);
  if (options_.has_prestress) state.texts[prestress_name] = "prestretch of elements";
  // A rank may have no nodes, but has the array like the others.
  if (global_max(*mesh_->comm, spring_offset_.empty() ? 0.0 : 1.0) > 0.0)
    state.arrays[offset_name] = fields::rows_of(spring_offset_, mesh_->n_owned);
}

std::string Solid::restore_history(const fields::State& state, const algebra::BlockVector& x) {
  TUNICA_CHECK((state.texts.count(prestress_name) > 0) == options_.has_prestress,
               std::string("Wall / Prestress: the state from which the run continues has ") +
                   (options_.has_prestress ? "none" : "one") +
                   ". A run continues with the prestress it began with.");
  spring_offset_.clear();
  if (state.has_array(offset_name))
    spring_offset_ =
        fields::ghosted_vectors(*mesh_, fields::as_vectors(state.array(offset_name, 3).values));
  return MixedField::restore_history(state, x);
}

std::map<std::string, fields::Restartable*> Solid::element_histories() {
  auto all = MixedField::element_histories();
  if (options_.has_prestress) all.emplace("prestretch", &prestretch_);
  return all;
}

// R = Σ_e R_e(d, p) + what surfaces add − f, f the nodal forces; K = dR/d(d, p), and where the wall
// stays on its mesh the derivative by a change of its prestretch.
void Solid::assemble(assembly::BlockAssembler* K) {
  R_.set_zero();
  assembly::assemble_solid(*mesh_, elements_, local_, R_, K);
  if (K != nullptr && stays_on_mesh_)
    assembly::assemble_prestretch(*mesh_, elements_, frames_, local_, *K);
  surfaces_.add(surroundings(), R_, K);
  for (int a = 0; a < mesh_->n_owned; ++a) R_.u[a] += -1.0 * nodal_force_[a];
}

}  // namespace tunica::discretisation
