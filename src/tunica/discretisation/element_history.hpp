#pragma once
#include "tunica/fields/field_mesh.hpp"
#include "tunica/fields/state.hpp"
#include "tunica/stepping/time_scheme.hpp"

namespace tunica::discretisation {

/// What a field remembers on its elements: a vector per local element, brought to each new time by
/// the time scheme of the field. A rank holds those of all its elements, shared ones too: each
/// computes them from the same values. Zero at the start. It is of the element: where the mesh
/// moves, it goes along.
class ElementHistory final : public fields::Restartable {
public:
  /// mesh and scheme must outlive the object.
  ElementHistory(const stepping::TimeScheme& scheme, const fields::FieldMesh& mesh)
      : mesh_(&mesh), scheme_(&scheme),
        history_(scheme.remembers(), static_cast<int>(mesh.tets.size())) {}

  const stepping::History& history() const { return history_; }
  /// Takes these values for those at the start.
  void start_from(std::vector<Vec3> values) { history_.value() = std::move(values); }
  void accept(const std::vector<Vec3>& values) { scheme_->accept(values, history_); }

  // Restartable: rows are elements
  fields::State save() const override;
  std::string restore(const fields::State& state) override;

private:
  const fields::FieldMesh* mesh_;
  const stepping::TimeScheme* scheme_;
  stepping::History history_;
};

}  // namespace tunica::discretisation
