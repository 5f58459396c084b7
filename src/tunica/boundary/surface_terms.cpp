#include "tunica/boundary/surface_terms.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "tunica/base/error.hpp"
#include "tunica/base/reduce.hpp"
#include "tunica/boundary/cap.hpp"
#include "tunica/boundary/surface_geometry.hpp"

namespace tunica::boundary {

namespace {

/// True where the flow slides along a surface, as on a plane of symmetry.
bool is_slid_along(const SurfaceTerms& terms, int surface) {
  const int held =
      terms.prescribes(surface, 0) + terms.prescribes(surface, 1) + terms.prescribes(surface, 2);
  return held == 1 || held == 2 || terms.has_held_directions(surface);
}

/// Lets profiles know where sections go on: a plane that lets pass what flows along the normal of a
/// section has no part in its rim. Collective.
void make_profiles(const SurfaceTerms& terms, const Terms& all, const fields::FieldMesh& mesh) {
  for (const auto& term : all) {
    auto* profile = dynamic_cast<SectionProfile*>(term.get());
    if (profile == nullptr) continue;
    const Vec3 normal = surface_geometry(mesh, profile->surface()).normal;
    std::vector<int> planes;
    for (int t = 0; t < static_cast<int>(mesh.surfaces.size()); ++t)
      if (t != profile->surface() && is_slid_along(terms, t) &&
          norm(terms.free_part(t, normal) - normal) < flat)
        planes.push_back(t);
    profile->make_profile(planes);
  }
}

}  // namespace

SurfaceTerms::SurfaceTerms(const std::vector<Condition>& conditions,
                           const std::vector<ConditionEntry>& registry,
                           const fields::FieldMesh& mesh)
    : mesh_(&mesh), kept_(conditions), conditions_(mesh.surfaces.size()),
      constraints_(mesh.surfaces.size()), face_loads_(mesh.surfaces.size()),
      whole_loads_(mesh.surfaces.size()), remembering_(mesh.surfaces.size()),
      fixed_(mesh.n_nodes()) {
  for (const Condition& condition : kept_) {
    const int surface = mesh.surface_index(condition.surface);
    if (surface < 0) continue;
    const std::string kind = condition.kind();
    const auto entry = std::find_if(registry.begin(), registry.end(),
                                    [&](const ConditionEntry& e) { return e.name == kind; });
    conditions_[surface].push_back(&condition);
    for (auto& term : entry->make(condition.list, mesh, surface)) take(std::move(term), surface);
  }
  check_sections();
  make_profiles(*this, terms_, mesh);
  constrain();
}

void SurfaceTerms::take(std::unique_ptr<BoundaryTerm> term, int surface) {
  if (auto* constraint = dynamic_cast<Constraint*>(term.get())) {
    highest_precedence_ = std::max(highest_precedence_, constraint->precedence());
    constraints_[surface].push_back(constraint);
  }
  if (auto* load = dynamic_cast<FaceLoad*>(term.get())) face_loads_[surface].push_back(load);
  if (auto* load = dynamic_cast<WholeLoad*>(term.get())) whole_loads_[surface].push_back(load);
  if (auto* one = dynamic_cast<Remembering*>(term.get())) remembering_[surface].push_back(one);
  terms_.push_back(std::move(term));
}

void SurfaceTerms::check_sections() const {
  const int n = static_cast<int>(constraints_.size());
  for (int s = 0; s < n; ++s) {
    const auto wants = [](const auto& term) { return term->wants_whole_section(); };
    if (std::none_of(constraints_[s].begin(), constraints_[s].end(), wants)) continue;
    for (int t = 0; t < n; ++t) {
      if (!is_slid_along(*this, t)) continue;
      double meets = 0.0;
      for (int a = 0; a < mesh_->n_owned; ++a)
        if (mesh_->is_on(a, s) && mesh_->is_on(a, t)) meets = 1.0;
      TUNICA_CHECK(
          global_max(*mesh_->comm, meets) == 0.0,
          "Surfaces / " + mesh_->surfaces[s] + ": the condition \"" +
              conditions_[s].front()->kind() +
              "\" makes a profile of the whole section of a vessel, but \"" + mesh_->surfaces[t] +
              "\", a plane of symmetry, cuts it. Give a \"flow rate\", whose profile goes on "
              "beyond the plane, a uniform velocity or a pressure.");
    }
  }
}

bool SurfaceTerms::has_condition(int surface, const std::string& kind) const {
  const auto& all = conditions_[surface];
  return std::any_of(all.begin(), all.end(),
                     [&kind](const Condition* each) { return each->kind() == kind; });
}

bool SurfaceTerms::sticks(int surface) const {
  const auto& terms = constraints_[surface];
  return std::any_of(terms.begin(), terms.end(), [](const auto& term) { return term->sticks(); });
}

bool SurfaceTerms::is_natural(int surface) const {
  const auto& terms = constraints_[surface];
  return std::all_of(terms.begin(), terms.end(), [](const auto& term) {
    return term->prescribed_components().empty() && term->held_directions().empty() &&
           term->common_motions().empty();
  });
}

bool SurfaceTerms::prescribes(int surface, int component) const {
  const auto& terms = constraints_[surface];
  return std::any_of(terms.begin(), terms.end(), [component](const auto& term) {
    std::vector<int> components = term->prescribed_components();
    for (const CommonMotion& motion : term->common_motions())
      components.push_back(motion.component);
    return std::find(components.begin(), components.end(), component) != components.end();
  });
}

bool SurfaceTerms::keeps_place(int surface) const {
  std::set<int> zero;
  for (const auto& term : constraints_[surface]) {
    if (term->keeps_place()) return true;
    if (!term->prescribes_zero()) continue;
    for (const int i : term->prescribed_components()) zero.insert(i);
  }
  return zero.size() == 3;
}

bool SurfaceTerms::moves_as_one(int surface) const {
  const auto& terms = constraints_[surface];
  return std::any_of(terms.begin(), terms.end(),
                     [](const auto& term) { return !term->common_motions().empty(); });
}

bool SurfaceTerms::has_held_directions(int surface) const {
  const auto& terms = constraints_[surface];
  return std::any_of(terms.begin(), terms.end(),
                     [](const auto& term) { return !term->held_directions().empty(); });
}

std::vector<Vec3> SurfaceTerms::sprung_directions(const fields::FieldMesh& mesh,
                                                  const fields::Face& face) const {
  std::vector<Vec3> all;
  for (const auto& term : face_loads_[face.surface])
    for (const Vec3& v : term->sprung_directions(mesh, face)) all.push_back(v);
  return all;
}

Vec3 SurfaceTerms::free_part(int surface, const Vec3& v) const {
  assembly::Constraints fixed(1);
  for (int i = 0; i < 3; ++i)
    if (prescribes(surface, i)) fixed.fix_component(0, i);
  for (const auto& term : constraints_[surface])
    for (const Vec3& n : term->held_directions()) fixed.fix_direction(0, n);
  return fixed.project(0, v);
}

// Components first: a direction that is theirs to a degree adds nothing.
void SurfaceTerms::constrain() {
  const auto at_nodes_of = [this](std::size_t s, const auto& fix) {
    for (int a = 0; a < mesh_->n_nodes(); ++a)
      if (mesh_->is_on(a, static_cast<int>(s))) fix(a);
  };
  std::vector<Vec3> given(mesh_->n_nodes());  // 1 for components with values, of terms in part
  for (std::size_t s = 0; s < constraints_.size(); ++s)
    for (const auto& term : constraints_[s]) {
      const std::vector<int> components = term->prescribed_components();
      const bool gives_some = components.size() < 3 && !term->prescribes_zero();
      at_nodes_of(s, [&](int a) {
        for (const int i : components) {
          fixed_.fix_component(a, i);
          if (gives_some) given[a][i] = 1.0;
        }
      });
    }
  bool is_clear = true;
  for (std::size_t s = 0; s < constraints_.size(); ++s)
    for (const auto& term : constraints_[s])
      for (const Vec3& n : term->held_directions())
        at_nodes_of(s, [&](int a) {
          fixed_.fix_direction(a, n);
          for (int i = 0; i < 3; ++i)
            if (std::abs(given[a][i] * n[i]) > flat) is_clear = false;
        });
  TUNICA_CHECK(all_agree(*mesh_->comm, is_clear),
               "Surfaces: at nodes that are held along a normal, another condition prescribes a "
               "component across it. Prescribe all components, or hold the plane by components.");
}

std::vector<std::pair<int, CommonMotion>> SurfaceTerms::common_motions() const {
  std::vector<std::pair<int, CommonMotion>> all;
  for (std::size_t s = 0; s < constraints_.size(); ++s)
    for (const auto& term : constraints_[s])
      for (const CommonMotion& motion : term->common_motions())
        all.emplace_back(static_cast<int>(s), motion);
  return all;
}

// On nodes that are held across the axes u ← g + P (u − g), g the prescribed components.
void SurfaceTerms::impose(const Surroundings& s, Vector& u) {
  for (const auto& terms : constraints_)
    for (const auto& term : terms) term->prepare(s);
  const auto values = u.getLocalViewHost(read_write);
  for (int precedence = 0; precedence <= highest_precedence_; ++precedence)
    for (std::size_t k = 0; k < constraints_.size(); ++k)
      for (const auto& term : constraints_[k]) {
        const std::vector<int> components = term->prescribed_components();
        if (components.empty() || term->precedence() != precedence) continue;
        for (int a = 0; a < mesh_->n_owned; ++a) {
          if (!mesh_->is_on(a, static_cast<int>(k))) continue;
          const Vec3 value = term->prescribed(s, a);
          for (const int i : components) values(3 * a + i, 0) = value[i];
        }
      }
  for (int a = 0; a < mesh_->n_owned; ++a) {
    if (fixed_.oblique(a) == nullptr) continue;
    Vec3 given{}, rest{};
    for (int i = 0; i < 3; ++i) (fixed_.is_fixed(a, i) ? given : rest)[i] = values(3 * a + i, 0);
    const Vec3 free = fixed_.project(a, rest);
    for (int i = 0; i < 3; ++i) values(3 * a + i, 0) = given[i] + free[i];
  }
}

void SurfaceTerms::add(const Surroundings& s, assembly::NodalResidual& R,
                       assembly::BlockAssembler* K) const {
  for (const fields::Face& face : mesh_->faces)
    for (const FaceLoad* load : face_loads_[face.surface]) load->add(s, face, R, K);
  for (const auto& loads : whole_loads_)
    for (const WholeLoad* load : loads) load->add_whole(s, R, K);
}

void SurfaceTerms::add_shape(const Surroundings& s, assembly::FluidShapeMatrix& S) const {
  for (const fields::Face& face : mesh_->faces)
    for (const FaceLoad* load : face_loads_[face.surface]) load->add_shape(s, face, S);
  for (const auto& loads : whole_loads_)
    for (const WholeLoad* load : loads) load->add_whole_shape(s, S);
}

int SurfaceTerms::rank() const {
  int sum = 0;
  for (const auto& loads : whole_loads_)
    for (const WholeLoad* load : loads) sum += load->rank();
  return sum;
}

Vec3 SurfaceTerms::load(const Surroundings& s, int surface) const {
  assembly::NodalResidual R(*mesh_);
  for (const fields::Face& face : mesh_->faces)
    if (face.surface == surface)
      for (const FaceLoad* load : face_loads_[surface]) load->add(s, face, R, nullptr);
  for (const WholeLoad* load : whole_loads_[surface]) load->add_whole(s, R, nullptr);
  Vec3 load{};
  for (const Vec3& r : R.u) load += -1.0 * r;
  return load;
}

void SurfaceTerms::observe(const Surroundings& s, const fields::Face& face,
                           std::map<std::string, double>& sums) const {
  for (const FaceLoad* load : face_loads_[face.surface]) load->observe(s, face, sums);
}

void SurfaceTerms::observe_whole(const Surroundings& s,
                                 std::map<std::string, double>& found) const {
  for (const auto& loads : whole_loads_)
    for (const WholeLoad* load : loads) load->observe_whole(s, found);
}

void SurfaceTerms::follow(const stepping::TimeScheme& scheme) {
  for (const auto& terms : remembering_)
    for (Remembering* term : terms) term->follow(scheme);
}

void SurfaceTerms::begin_step() {
  for (const auto& terms : remembering_)
    for (Remembering* term : terms) term->begin_step();
}

void SurfaceTerms::end_step(const Surroundings& s) {
  for (const auto& terms : remembering_)
    for (Remembering* term : terms) term->end_step(s);
}

std::vector<double> SurfaceTerms::state_of(int surface) const {
  std::vector<double> all;
  for (const Remembering* term : remembering_[surface]) {
    const std::vector<double> one = term->state();
    all.insert(all.end(), one.begin(), one.end());
  }
  return all;
}

std::string SurfaceTerms::name_of_state(int surface) const {
  std::string kinds;
  for (const Condition* each : conditions_[surface])
    kinds += (kinds.empty() ? "" : " and ") + each->kind();
  return kinds + " at " + mesh_->surfaces[surface];
}

void SurfaceTerms::save(fields::State& state) const {
  for (int k = 0; k < static_cast<int>(remembering_.size()); ++k)
    if (const std::vector<double> values = state_of(k); !values.empty())
      state.numbers[name_of_state(k)] = values;
}

std::string SurfaceTerms::restore(const fields::State& state) {
  std::string remark;
  for (int k = 0; k < static_cast<int>(remembering_.size()); ++k) {
    const std::size_t size = state_of(k).size();
    if (size == 0) continue;
    const auto found = state.numbers.find(name_of_state(k));
    if (found == state.numbers.end()) {
      remark += (remark.empty() ? "the " : "; the ") + name_of_state(k) + " begins anew";
      continue;
    }
    TUNICA_CHECK(found->second.size() == size,
                 "the state of the " + name_of_state(k) + " has " +
                     std::to_string(found->second.size()) + " numbers, expected " +
                     std::to_string(size) +
                     ": a run continues with the time scheme it began with.");
    auto next = found->second.begin();
    for (const auto& term : remembering_[k]) {
      const auto count = static_cast<std::ptrdiff_t>(term->state().size());
      term->restore({next, next + count});
      next += count;
    }
  }
  return remark;
}

}  // namespace tunica::boundary
