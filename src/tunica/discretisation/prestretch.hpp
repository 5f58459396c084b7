#pragma once
#include <functional>

#include "tunica/fields/field_mesh.hpp"
#include "tunica/fields/state.hpp"

namespace tunica::discretisation {

/// The deformation gradient G of each local element from where it is free of stress to the mesh;
/// none where the mesh is. A run keeps it from step to step.
class Prestretch final : public fields::Restartable {
public:
  /// followed: is called when a state has been restored.
  Prestretch(const fields::FieldMesh& mesh, std::function<void()> followed)
      : places_(fields::Places::elements(mesh)), followed_(std::move(followed)) {}

  /// The prestretches; always the same object.
  const std::vector<Mat3>& values() const { return values_; }
  void set(std::vector<Mat3> values) { values_ = std::move(values); }

  // Restartable: rows are elements
  fields::State save() const override;
  std::string restore(const fields::State& state) override;

private:
  fields::Places places_;
  std::function<void()> followed_;
  std::vector<Mat3> values_;
};

}  // namespace tunica::discretisation
