#include "tunica/problems/step_error.hpp"

#include <algorithm>
#include <cmath>

#include "tunica/problems/fluid_problem.hpp"
#include "tunica/problems/solid_problem.hpp"

namespace tunica::problems {

StepTolerance step_tolerance(const Teuchos::ParameterList& time) {
  const bool is_steady_sought = time.get<std::string>("step control") == "steady";
  return {time.get<double>("tolerance"),
          is_steady_sought ? 0.0 : time.get<double>("displacement scale"),
          time.get<double>("velocity scale"), is_steady_sought};
}

StepError::StepError(FieldProblem& field, const stepping::TimeScheme& scheme,
                     const StepTolerance& tolerance)
    : field_(&field), scheme_(&scheme), is_steady_sought_(tolerance.is_steady_sought),
      permitted_(
          std::pow(tolerance.tolerance, is_steady_sought_ ? 1.0 : 1.0 + 1.0 / scheme.order())) {}

StepError::StepError(FluidProblem& fluid, const StepTolerance& tolerance)
    : StepError(fluid, fluid.time_scheme(), tolerance) {
  watch({"velocity",
         tolerance.velocity_scale,
         [&fluid] { return fields::owned_vectors(fluid.mesh(), fluid.state()["velocity"]); },
         [this](const auto& sizes) { return scheme_->value_error(sizes); },
         {}});
}

StepError::StepError(SolidProblem& wall, const StepTolerance& tolerance)
    : StepError(wall, wall.time_scheme(), tolerance) {
  watch({"displacement",
         tolerance.displacement_scale,
         [&wall] { return wall.displacement(); },
         [this](const auto& sizes) { return scheme_->value_error(sizes); },
         {}});
  watch({"velocity",
         tolerance.velocity_scale,
         [&wall] { return wall.velocity(); },
         [this](const auto& sizes) { return scheme_->velocity_error(sizes); },
         {}});
}

void StepError::watch(Quantity quantity) {
  quantity.past.assign(3, quantity.now());
  quantities_.push_back(std::move(quantity));
}

double StepError::norm_of(const Values& values) const {
  algebra::BlockVector x(field_->space()), one(field_->space());
  fields::store(values, field_->mesh(), x[0]);
  fields::store(Values(values.size(), Vec3{1.0, 0.0, 0.0}), field_->mesh(), one[0]);
  return field_->increment_norm(x) / field_->increment_norm(one);
}

StepError::Estimate StepError::estimate(const Quantity& quantity,
                                        const stepping::StepSizes& sizes) const {
  const stepping::ErrorFormula formula =
      is_steady_sought_ ? stepping::ErrorFormula{0, 1.0} : quantity.formula(sizes);
  const auto weights = stepping::extrapolation(formula.degree, sizes);
  const Values now = quantity.now();
  Values error(now);
  for (std::size_t a = 0; a < error.size(); ++a) {
    for (int k = 0; k <= formula.degree; ++k) error[a] += -weights[k] * quantity.past[k][a];
    error[a] = formula.constant * error[a];  // C (x − xᵖ)
  }
  const double largest = is_steady_sought_ ? 0.0 : quantity.largest;
  const double scale = std::max({quantity.smallest_scale, largest, norm_of(now)});
  Estimate found;
  found.ratio = norm_of(error) / (permitted_ * scale);
  found.eta = std::pow(found.ratio, 1.0 / (formula.degree + 1));
  return found;
}

StepError::Estimate StepError::estimate(const stepping::Clock& clock) {
  Estimate worst;
  for (const Quantity& quantity : quantities_) {
    const Estimate one = estimate(quantity, clock.step_sizes());
    if (!(one.eta <= worst.eta)) worst = one;
  }
  return worst;
}

void StepError::accept() {
  for (Quantity& quantity : quantities_) {
    quantity.past.push_front(quantity.now());
    quantity.past.pop_back();
    quantity.largest = std::max(quantity.largest, norm_of(quantity.past.front()));
  }
}

fields::State StepError::save() const {
  fields::State state = fields::state_on(field_->mesh());
  for (const Quantity& quantity : quantities_) {
    int k = 0;
    for (const Values& values : quantity.past)
      state.arrays[quantity.name + " " + std::to_string(++k)] =
          fields::rows_of(values, field_->mesh().n_owned);
    state.numbers["largest " + quantity.name] = {quantity.largest};
  }
  return state;
}

std::string StepError::restore(const fields::State& state) {
  for (Quantity& quantity : quantities_) {
    int k = 0;
    for (Values& values : quantity.past) {
      const auto& rows = state.array(quantity.name + " " + std::to_string(++k), 3).values;
      for (std::size_t a = 0; a < values.size(); ++a)
        values[a] = {rows[3 * a], rows[3 * a + 1], rows[3 * a + 2]};
    }
    quantity.largest = state.number_list("largest " + quantity.name).at(0);
  }
  return "";
}

}  // namespace tunica::problems
