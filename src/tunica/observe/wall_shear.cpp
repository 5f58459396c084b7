#include "tunica/observe/wall_shear.hpp"

#include <algorithm>
#include <sstream>

#include "tunica/base/reduce.hpp"
#include "tunica/observe/arrays.hpp"

namespace tunica::observe {

namespace {

constexpr const char* averages_key = "averages from";

}  // namespace

void add_wall_shear_keys(params::Table& table) {
  table.number(averages_key, 0.0, params::non_negative(), "ms",
               "time from which the wall shear stress is averaged; with several beats, the "
               "beginning of the last one");
}

double averages_from(const Teuchos::ParameterList& output) {
  return output.isParameter(averages_key) ? output.get<double>(averages_key) : 0.0;
}

WallShear::WallShear(const ShearAverages& averages, problems::FluidProblem& fluid)
    : fluid_(&fluid), averages_(averages), stress_(fluid.mesh().n_owned), integral_(stress_.size()),
      integral_of_size_(stress_.size(), 0.0) {}

void WallShear::accept(const stepping::Clock& clock) {
  stress_ = fluid_->wall_shear_stress();
  if (averages_.is_steady) {  // T = 1, all of it now
    duration_ = 1.0;
    integral_ = stress_;
    for (std::size_t a = 0; a < stress_.size(); ++a) integral_of_size_[a] = norm(stress_[a]);
    return;
  }
  const double dt = std::min(clock.step_size(), clock.time() - averages_.from);
  if (dt <= 1e-9 * clock.step_size()) return;
  duration_ += dt;
  for (std::size_t a = 0; a < stress_.size(); ++a) {
    integral_[a] += dt * stress_[a];
    integral_of_size_[a] += dt * norm(stress_[a]);
  }
}

std::vector<output::Array> WallShear::arrays() const {
  if (duration_ == 0.0)
    return {vector_array("wall_shear_stress", stress_, static_cast<int>(stress_.size()))};
  output::Array mean{"time_averaged_wss", 1, {}}, osi{"oscillatory_shear_index", 1, {}},
      rrt{"relative_residence_time", 1, {}};
  for (std::size_t a = 0; a < stress_.size(); ++a) {
    const double size = integral_of_size_[a], along = norm(integral_[a]);
    mean.values.push_back(size / duration_);
    osi.values.push_back(size > 0.0 ? 0.5 * (1.0 - along / size) : 0.0);
    // (1 − 2 OSI) TAWSS = |∫ τ dt|/T
    rrt.values.push_back(along > 0.0 ? duration_ / along : 0.0);
  }
  return {vector_array("wall_shear_stress", stress_, static_cast<int>(stress_.size())), mean, osi,
          rrt};
}

discretisation::Observables WallShear::observe() const {
  double largest = 0.0;
  for (const Vec3& t : stress_) largest = std::max(largest, norm(t));
  return {{"max_wall_shear_stress_kPa", global_max(*fluid_->mesh().comm, largest)}};
}

fields::State WallShear::save() const {
  fields::State state = fields::state_on(fluid_->mesh());
  state.numbers["from"] = {averages_.from};
  state.numbers["duration"] = {duration_};
  state.arrays["integral"] = fields::rows_of(integral_, fluid_->mesh().n_owned);
  state.arrays["integral of size"] = {1, integral_of_size_};
  return state;
}

std::string WallShear::restore(const fields::State& state) {
  const auto told = state.numbers.find("from");  // older checkpoints do not
  const double was = told == state.numbers.end() ? averages_.from : told->second.at(0);
  if (was != averages_.from) {
    std::ostringstream text;
    text << "The averages of the wall shear stress begin anew, since \"" << averages_key
         << "\" was " << was << " ms and is " << averages_.from << " ms.";
    return text.str();
  }
  duration_ = state.number_list("duration").at(0);
  const std::vector<double>& rows = state.array("integral", 3).values;
  for (std::size_t a = 0; a < integral_.size(); ++a)
    integral_[a] = {rows[3 * a], rows[3 * a + 1], rows[3 * a + 2]};
  integral_of_size_ = state.array("integral of size", 1).values;
  return "";
}

}  // namespace tunica::observe
