#include <algorithm>

#include "fields/reduce.hpp"
#include "problems/fluid_problem.hpp"

namespace tunica::problems {

Observables FluidProblem::observe() const {
  const Comm& comm = *mesh_->comm;
  const std::vector<Vec3> u = fields::ghosted_vectors(*mesh_, *x_.u);
  const std::vector<double> p = fields::ghosted_scalars(*mesh_, *x_.p);
  Observables found;
  for (std::size_t s = 0; s < condition_of_surface_.size(); ++s) {
    const FlowCondition* condition = condition_of_surface_[s];
    if (condition == nullptr || condition->kind == "interface" || condition->kind == "no slip")
      continue;
    double inflow = 0.0;
    for (const fields::Face& face : mesh_->faces) {
      if (face.surface != static_cast<int>(s) || !face.is_counted) continue;
      inflow -= outflow(face, u);
    }
    found.push_back(
        {"inflow_" + condition->surface + "_mm3_per_ms", fields::global_sum(comm, inflow)});
  }
  double low = 1e300, high = -1e300, speed = 0.0, volume = 0.0;
  for (int a = 0; a < mesh_->n_owned; ++a) {
    low = std::min(low, p[a]);
    high = std::max(high, p[a]);
    speed = std::max(speed, norm(u[a]));
  }
  for (std::size_t e = 0; e < mesh_->tets.size(); ++e)
    if (mesh_->is_counted[e]) volume += elements_.geometry[e].volume;
  found.push_back({"fluid_pressure_min_kPa", fields::global_min(comm, low)});
  found.push_back({"fluid_pressure_max_kPa", fields::global_max(comm, high)});
  found.push_back({"max_speed_mm_per_ms", fields::global_max(comm, speed)});
  found.push_back({"fluid_volume_mm3", fields::global_sum(comm, volume)});
  return found;
}

}  // namespace tunica::problems
