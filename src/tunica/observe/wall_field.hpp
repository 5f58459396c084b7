#pragma once
#include "tunica/observe/field.hpp"
#include "tunica/params/table.hpp"
#include "tunica/problems/solid_problem.hpp"
#include "tunica/problems/stress_recovery.hpp"

namespace tunica::observe {

/// The quantities of probes in a wall.
std::vector<Quantity> wall_quantities();

/// The wall of a run. What fields.h5 has of it: At nodes: displacement, pressure, velocity, and
/// what of the following needs stress alone, as it is recovered from the elements around. Of
/// elements, as the list "Output" wants it: stresses; principal stresses and stretches; with fibres
/// the circumferential and the axial direction in the unloaded wall, and the fibres in the deformed
/// one, as long as they are stretched; and how far their stress is from that at the nodes.
class WallField final : public Field {
public:
  /// kinds: of arrays. wall must outlive the object. Collective.
  WallField(problems::SolidProblem& wall, std::vector<std::string> kinds);

  std::string name() const override { return "wall"; }
  const fields::FieldMesh& mesh() const override { return wall_->mesh(); }
  Parts parts() override { return {{"wall", wall_}}; }
  std::unique_ptr<problems::StepError> step_error(const problems::StepTolerance&) override;
  discretisation::Observables observe() override { return wall_->observe(); }
  discretisation::Observables observe_surfaces(const std::vector<int>& surfaces) override {
    return wall_->observe_surfaces(surfaces);
  }
  std::vector<Quantity> quantities() const override { return wall_quantities(); }
  Sampler sampler() override;
  output::Grid grid() override;
  GridFields arrays() override;
  const Throughput* throughput() const override { return &wall_->jacobian_throughput(); }

private:
  bool has(const std::string& kind) const;
  std::vector<output::Array> node_arrays() const;
  std::vector<output::Array> cell_arrays() const;
  void add_recovered(const problems::NodalStress& nodal, GridFields& fields) const;

  problems::SolidProblem* wall_;
  problems::StressRecovery recovery_;
  std::vector<std::string> kinds_;
};
/// Adds the key of what it writes to an "Output" list, and its kinds in a resolved one.
void add_wall_array_keys(params::Table& table);
std::vector<std::string> wall_arrays_in(const Teuchos::ParameterList& output);

}  // namespace tunica::observe
