#include "tunica/discretisation/mixed_field.hpp"

#include <stdexcept>
#include <string>

#include "tunica/assembly/mass_norm.hpp"
#include "tunica/base/error.hpp"

namespace tunica::discretisation {

// Unknowns that move as one are constraints beside those of the surfaces, and bring two products of
// vectors each. In products_ those of the surfaces stand first.
MixedField::MixedField(const fields::FieldMesh& mesh, Parts parts)
    : mesh_(&mesh), split_(std::move(parts.split)), scheme_(std::move(parts.scheme)),
      timeline_(fields::Places::nodes(mesh), 3, scheme_->remembers()),
      surfaces_(parts.conditions, parts.registry, mesh), fixed_(surfaces_.constraints()),
      R_(mesh, split_.get()), blocks_(parts.blocks), is_solid_(parts.is_solid),
      space_(fields::nodal_space(mesh, blocks_, split_.get())),
      common_motions_(mesh, split_.get()) {
  surfaces_.follow(*scheme_);
  tie_surfaces();
  const int rank = surfaces_.rank() + common_motions_.rank();
  if (rank > 0) products_ = std::make_shared<algebra::LowRank>(space_, rank);
}

// A field that is part of a system assembles into the matrix of the whole and needs none itself.
fields::BlockOperator& MixedField::matrix() const {
  if (!K_) {
    fields::MeshParts parts;
    parts.is_solid.assign(mesh_->regions.size(), is_solid_ ? 1 : 0);
    K_ = std::make_unique<fields::BlockOperator>(*mesh_, blocks_, split_.get(), parts);
    K_->share_low_rank(products_);
  }
  return *K_;
}

const fields::NodeGraph& MixedField::scalar_graph() const {
  if (!scalar_graph_)
    scalar_graph_ = std::make_unique<fields::NodeGraph>(fields::make_node_graph(scalar_mesh()));
  return *scalar_graph_;
}

// Nodes whose component another condition prescribes are no members: with none left there is no
// unknown that could move.
void MixedField::tie_surfaces() {
  std::vector<char> members(mesh_->n_nodes());
  for (const auto& [surface, motion] : surfaces_.common_motions()) {
    for (int a = 0; a < mesh_->n_nodes(); ++a) members[a] = mesh_->is_on(a, surface);
    const int count = common_motions_.add(motion.component, motion.has_force, members, fixed_);
    TUNICA_CHECK(count > 0,
                 "Surfaces / " + mesh_->surfaces[surface] + ": it is to move as one along " +
                     "xyz"[motion.component] +
                     ", but other conditions prescribe this component at all of its nodes.");
    given_motions_.push_back(motion);
  }
}

// ū or P of each motion, at the instant of the other loads
std::vector<double> MixedField::motion_values() const {
  std::vector<double> values;
  for (const boundary::CommonMotion& motion : given_motions_)
    values.push_back(motion.value(surroundings().time));
  return values;
}

// awaited_ names the call that has to come next; null permits residuals. begin() opens a step, and
// wait_for() goes on within one.
void MixedField::begin(const char* awaited) {
  has_begun_ = true;
  awaited_ = awaited;
  has_been_ready_ = has_been_ready_ || awaited == nullptr;
}

void MixedField::wait_for(const char* awaited) {
  if (awaited_ == first_call)
    throw std::logic_error(std::string("a call within a time step comes before ") + first_call);
  begin(awaited);
}

void MixedField::wait_after_move_for(const char* awaited) {
  // Between steps only the next begin_step() is awaited, and a domain may move before it.
  const bool is_between_steps = has_begun_ && awaited_ == first_call;
  if (!is_between_steps) wait_for(awaited);
}

void MixedField::check_ready() const {
  if (awaited_ != nullptr)
    throw std::logic_error(std::string("a residual or a Jacobian comes before ") + awaited_);
}

// F = P R with the projectors P of the constraints; in the rows of members, which P makes zero,
// stands the equation of their motion.
Outcome MixedField::residual(const algebra::BlockVector& x, algebra::BlockVector& F) {
  check_ready();
  read(x);
  if (Outcome outcome = is_admissible(); outcome.is_failure()) return outcome;
  assemble(nullptr);
  R_.store(fixed_, F);
  common_motions_.store(R_, *surroundings().u, motion_values(), F);
  return Outcome::success();
}

void MixedField::assemble_jacobian(const algebra::BlockVector& x) {
  check_ready();
  read(x);
  assembly::BlockAssembler assembler(matrix(), fixed_, common_motions());
  fill(assembler);
}

// K ← K + R Pᵀ K_field P S in numbers and units of the whole, see algebra::Embedding
void MixedField::add_jacobian(const algebra::BlockVector& x, const assembly::Whole& whole) {
  check_ready();
  read(x);
  assembly::BlockAssembler assembler(whole, *mesh_, fixed_, common_motions(), products_.get());
  fill(assembler);
}

void MixedField::fill(assembly::BlockAssembler& K) {
  const Stopwatch watch;
  assemble(&K);
  K.finish();
  throughput_.items += static_cast<long long>(mesh_->tets.size());
  throughput_.seconds += watch.seconds();
}

stepping::Timeline* MixedField::remember(const std::string& name, stepping::Timeline timeline,
                                         Accept accept) {
  on_elements_.push_back(
      {name, std::make_unique<stepping::Timeline>(std::move(timeline)), std::move(accept)});
  return on_elements_.back().timeline.get();
}

// Vectors of elements march with the scheme of the nodal one: x̃ and what follows from it are made
// alike.
stepping::Timeline* MixedField::remember(const std::string& name, const ElementValues& values) {
  return remember(name, {fields::Places::elements(*mesh_), 3, scheme_->remembers()},
                  [this, values](stepping::Timeline& past) {
                    scheme_->accept(fields::as_rows(values()), past);
                  });
}

std::map<std::string, fields::Restartable*> MixedField::element_histories() {
  std::map<std::string, fields::Restartable*> all;
  for (const ElementQuantity& quantity : on_elements_)
    all.emplace(quantity.name, quantity.timeline.get());
  return all;
}

// What elements remember is evaluated at the accepted x.
void MixedField::end_step(const algebra::BlockVector& x) {
  wait_for(first_call);
  read(x);
  for (const ElementQuantity& quantity : on_elements_) quantity.accept(*quantity.timeline);
  scheme_->accept(fields::as_rows(*surroundings().u), timeline_);
  surfaces_.end_step(surroundings());
}

void MixedField::save_history(fields::State& state) const {
  timeline_.save_past("", state);
  surfaces_.save(state);
}

// The value of the last step is x, with its ghosts; only what lies before is stored beside it.
std::string MixedField::restore_history(const fields::State& state, const algebra::BlockVector& x) {
  timeline_.restore_past("", state, fields::as_rows(fields::ghosted_vectors(*mesh_, x[0])));
  return surfaces_.restore(state);
}

// δ_a ← P_a δ_a, δp ← 0 where p is fixed, δ_a ← Σ_b δ_b/n for the n members of a motion: what the
// residual takes for granted, and an inexact solve misses.
void MixedField::hold_prescribed(algebra::BlockVector& dx) const {
  // Before the projection, which takes members for fixed
  const std::vector<double> common = common_motions_.means(dx[0]);
  {
    const auto u = dx[0].getLocalViewHost(read_write);
    for (int a = 0; a < mesh_->n_owned; ++a) {
      if (fixed_.is_free(a)) continue;
      const Vec3 free = fixed_.project(a, {u(3 * a, 0), u(3 * a + 1, 0), u(3 * a + 2, 0)});
      for (int i = 0; i < 3; ++i) u(3 * a + i, 0) = free[i];
    }
    const auto p = dx[1].getLocalViewHost(read_write);
    for (int a = 0; a < scalar_mesh().n_owned; ++a)
      if (fixed_.is_scalar_fixed(fields::host_of(a, split()))) p(a, 0) = 0.0;
  }
  common_motions_.insert(common, dx[0]);
}

// ‖δ‖ = (∫ |δu|² + δp² dV)^½
double MixedField::mass_norm(const algebra::BlockVector& dx) const {
  return assembly::mass_norm(*mesh_, scalar_mesh(), geometry(), dx);
}

}  // namespace tunica::discretisation
