#include "tunica/boundary/surface_terms.hpp"

#include <algorithm>

namespace tunica::boundary {

SurfaceTerms::SurfaceTerms(const std::vector<Condition>& conditions,
                           const std::vector<ConditionEntry>& registry,
                           const fields::FieldMesh& mesh)
    : mesh_(&mesh), kept_(conditions), conditions_(mesh.surfaces.size(), nullptr),
      terms_(mesh.surfaces.size()) {
  for (const Condition& condition : kept_) {
    const int surface = mesh.surface_index(condition.surface);
    if (surface < 0) continue;
    const std::string kind = condition.kind();
    const auto entry = std::find_if(registry.begin(), registry.end(),
                                    [&](const ConditionEntry& e) { return e.name == kind; });
    conditions_[surface] = &condition;
    terms_[surface] = entry->make(condition.list, mesh, surface);
    for (const auto& term : terms_[surface])
      highest_precedence_ = std::max(highest_precedence_, term->precedence());
  }
}

bool SurfaceTerms::is_natural(int surface) const {
  const Terms& terms = terms_[surface];
  return std::all_of(terms.begin(), terms.end(),
                     [](const auto& term) { return term->prescribed_components().empty(); });
}

bool SurfaceTerms::prescribes(int surface, int component) const {
  const Terms& terms = terms_[surface];
  return std::any_of(terms.begin(), terms.end(), [component](const auto& term) {
    const std::vector<int> components = term->prescribed_components();
    return std::find(components.begin(), components.end(), component) != components.end();
  });
}

void SurfaceTerms::constrain(assembly::Constraints& fixed) const {
  for (std::size_t s = 0; s < terms_.size(); ++s)
    for (const auto& term : terms_[s])
      for (const int i : term->prescribed_components())
        for (int a = 0; a < mesh_->n_nodes(); ++a)
          if (mesh_->is_on(a, static_cast<int>(s))) fixed[a] |= std::uint8_t(1U << i);
}

void SurfaceTerms::impose(const Surroundings& s, Vector& u) const {
  const auto values = u.getLocalViewHost(read_write);
  for (int precedence = 0; precedence <= highest_precedence_; ++precedence)
    for (std::size_t k = 0; k < terms_.size(); ++k)
      for (const auto& term : terms_[k]) {
        const std::vector<int> components = term->prescribed_components();
        if (components.empty() || term->precedence() != precedence) continue;
        for (int a = 0; a < mesh_->n_owned; ++a) {
          if (!mesh_->is_on(a, static_cast<int>(k))) continue;
          const Vec3 value = term->prescribed(s, a);
          for (const int i : components) values(3 * a + i, 0) = value[i];
        }
      }
}

void SurfaceTerms::add(const Surroundings& s, assembly::NodalResidual& R,
                       assembly::BlockAssembler* K) const {
  for (const fields::Face& face : mesh_->faces)
    for (const auto& term : terms_[face.surface]) term->add(s, face, R, K);
}

Vec3 SurfaceTerms::load(const Surroundings& s, int surface) const {
  assembly::NodalResidual R(*mesh_);
  for (const fields::Face& face : mesh_->faces)
    if (face.surface == surface)
      for (const auto& term : terms_[surface]) term->add(s, face, R, nullptr);
  Vec3 load{};
  for (const Vec3& r : R.u) load += -1.0 * r;
  return load;
}

void SurfaceTerms::observe(const Surroundings& s, const fields::Face& face,
                           std::map<std::string, double>& sums) const {
  for (const auto& term : terms_[face.surface]) term->observe(s, face, sums);
}

}  // namespace tunica::boundary
