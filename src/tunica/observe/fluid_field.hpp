#pragma once
#include "tunica/observe/field.hpp"
#include "tunica/observe/wall_shear.hpp"
#include "tunica/problems/mesh_motion.hpp"

namespace tunica::observe {

/// The quantities of probes in a fluid.
std::vector<Quantity> fluid_quantities();

/// The fluid of a run, its wall shear stress and the motion of its mesh.
class FluidField final : public Field {
public:
  /// motion: null where the mesh stands still. Fluid and motion must outlive the object.
  FluidField(const ShearAverages& averages, problems::FluidProblem& fluid,
             problems::MeshMotion* motion);

  std::string name() const override { return "fluid"; }
  const fields::FieldMesh& mesh() const override { return fluid_->mesh(); }
  Parts parts() override;
  std::unique_ptr<problems::StepError> step_error(const problems::StepTolerance&) override;
  void accept(const stepping::Clock& clock) override { shear_.accept(clock); }
  discretisation::Observables observe() override;
  discretisation::Observables observe_surfaces(const std::vector<int>& surfaces) override {
    return fluid_->observe_surfaces(surfaces);
  }
  std::vector<Quantity> quantities() const override { return fluid_quantities(); }
  Sampler sampler() override;
  /// Velocity, pressure, and the mesh's displacement where it moves, which is called as that of the
  /// wall, so that one filter moves both; and what WallShear has.
  GridFields arrays() override;
  const Throughput* throughput() const override { return &fluid_->jacobian_throughput(); }

private:
  problems::FluidProblem* fluid_;
  problems::MeshMotion* motion_;
  WallShear shear_;
};

}  // namespace tunica::observe
