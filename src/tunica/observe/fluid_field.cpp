#include "tunica/observe/fluid_field.hpp"

#include "tunica/observe/arrays.hpp"

namespace tunica::observe {

namespace {

constexpr const char* pressure = "fluid pressure";
constexpr const char* velocity = "fluid velocity ";

}  // namespace

std::vector<Quantity> fluid_quantities() {
  std::vector<Quantity> all{{pressure, "kPa"}};
  for (const char* i : {"x", "y", "z"}) all.push_back({std::string(velocity) + i, "mm_per_ms"});
  return all;
}

FluidField::FluidField(const ShearAverages& averages, problems::FluidProblem& fluid,
                       problems::MeshMotion* motion)
    : fluid_(&fluid), motion_(motion), shear_(averages, fluid) {}

Parts FluidField::parts() {
  Parts all{{"fluid", fluid_}, {"wall shear", &shear_}};
  if (motion_ != nullptr) all.emplace_back("mesh motion", motion_);
  return all;
}

std::unique_ptr<problems::StepError> FluidField::step_error(
    const problems::StepTolerance& tolerance) {
  return std::make_unique<problems::StepError>(*fluid_, tolerance);
}

discretisation::Observables FluidField::observe() {
  discretisation::Observables all = fluid_->observe();
  for (const discretisation::Observable& o : shear_.observe()) all.push_back(o);
  return all;
}

Sampler FluidField::sampler() {
  return [u = fields::ghosted_vectors(fluid_->mesh(), fluid_->state()["velocity"]),
          p = fields::ghosted_scalars(fluid_->mesh(), fluid_->state()["pressure"])](
             const std::string& quantity, const fields::Place& at) {
    return quantity == pressure ? at.value(p) : at.value(u)[quantity.back() - 'x'];
  };
}

GridFields FluidField::arrays() {
  GridFields all{"fluid",
                 {dof_array("velocity", 3, fluid_->state()["velocity"]),
                  dof_array("pressure", 1, fluid_->state()["pressure"])},
                 {}};
  if (motion_ != nullptr)
    all.points.push_back(
        vector_array("displacement", motion_->displacement(), fluid_->mesh().n_owned));
  for (output::Array& array : shear_.arrays()) all.points.push_back(std::move(array));
  return all;
}

}  // namespace tunica::observe
