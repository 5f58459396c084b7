#include "tunica/problems/step_error.hpp"

#include <algorithm>
#include <cmath>

#include "tunica/problems/fluid_problem.hpp"
#include "tunica/problems/solid_problem.hpp"

namespace tunica::problems {

// Where a steady state is sought a displacement is judged by its own size, unless there is none.
StepTolerance step_tolerance(const Teuchos::ParameterList& time) {
  const bool is_steady_sought = time.get<std::string>("step control") == "steady";
  return {time.get<double>("tolerance"),
          is_steady_sought ? 1e-9 : time.get<double>("displacement scale"),
          time.get<double>("velocity scale"), is_steady_sought};
}

// permitted = ε^((p + 1)/p), p the order of the scheme; ε itself where a steady flow is sought
StepError::StepError(FieldProblem& field, const stepping::TimeScheme& scheme,
                     const StepTolerance& tolerance)
    : field_(&field), scheme_(&scheme), is_steady_sought_(tolerance.is_steady_sought),
      permitted_(
          std::pow(tolerance.tolerance, is_steady_sought_ ? 1.0 : 1.0 + 1.0 / scheme.order())) {}

// u alone: the pressure has no equation in time.
StepError::StepError(FluidProblem& fluid, const StepTolerance& tolerance)
    : StepError(fluid, fluid.time_scheme(), tolerance) {
  watch(
      "velocity", tolerance.velocity_scale,
      [&fluid] { return fields::owned_vectors(fluid.mesh(), fluid.state()["velocity"]); },
      [this](const auto& sizes) { return scheme_->value_error(sizes); });
}

// d, and v by a formula of its own, as Newmark's scheme may lose another order in it
StepError::StepError(SolidProblem& wall, const StepTolerance& tolerance)
    : StepError(wall, wall.time_scheme(), tolerance) {
  watch(
      "displacement", tolerance.displacement_scale, [&wall] { return wall.displacement(); },
      [this](const auto& sizes) { return scheme_->value_error(sizes); });
  watch(
      "velocity", tolerance.velocity_scale, [&wall] { return wall.velocity(); },
      [this](const auto& sizes) { return scheme_->velocity_error(sizes); });
}

void StepError::watch(const std::string& name, double smallest_scale, std::function<Values()> now,
                      std::function<stepping::ErrorFormula(const stepping::StepSizes&)> formula) {
  stepping::Timeline past(fields::Places::owned_nodes(field_->mesh()), 3, {}, 3);
  // Before the start all was as at the start.
  for (int k = 0; k < 3; ++k) past.push(fields::as_rows(now()));
  quantities_.push_back({name, smallest_scale, std::move(now), std::move(formula), past, 0.0});
}

// ‖x‖ = |x|_M/|e|_M = (∫ |x|² dV/V)^½, e of length one everywhere
double StepError::norm_of(const Values& values) const {
  algebra::BlockVector x(field_->space()), one(field_->space());
  fields::store(values, field_->mesh(), x[0]);
  fields::store(Values(values.size(), Vec3{1.0, 0.0, 0.0}), field_->mesh(), one[0]);
  return field_->increment_norm(x) / field_->increment_norm(one);
}

StepError::Estimate StepError::estimate(const Quantity& quantity,
                                        const stepping::StepSizes& sizes) const {
  // xᵖ = Σ_k c_k xⁿ⁻ᵏ of degree q. In search of a steady flow xᵖ = xⁿ⁻¹ and C = 1: what counts is
  // how much the step has changed.
  const stepping::ErrorFormula formula =
      is_steady_sought_ ? stepping::ErrorFormula{0, 1.0} : quantity.formula(sizes);
  const auto weights = stepping::extrapolation(formula.degree, sizes);
  const Values now = quantity.now();
  stepping::Rows error = fields::as_rows(now);
  for (std::size_t i = 0; i < error.size(); ++i) {
    for (int k = 0; k <= formula.degree; ++k) error[i] += -weights[k] * quantity.past.value(k)[i];
    error[i] *= formula.constant;  // C (x − xᵖ)
  }
  // ‖C (x − xᵖ)‖ / (permitted · max(s, ‖x‖ at its largest)),   η = ratio^(1/(q + 1))
  const double largest = is_steady_sought_ ? 0.0 : quantity.largest;
  const double scale = std::max({quantity.smallest_scale, largest, norm_of(now)});
  Estimate found;
  found.ratio = norm_of(fields::as_vectors(error)) / (permitted_ * scale);
  found.eta = std::pow(found.ratio, 1.0 / (formula.degree + 1));
  return found;
}

StepError::Estimate StepError::estimate(const stepping::Clock& clock) {
  Estimate worst;
  for (const Quantity& quantity : quantities_) {
    const Estimate one = estimate(quantity, clock.step_sizes());
    // NaN is worse than anything.
    if (!(one.eta <= worst.eta)) worst = one;
  }
  return worst;
}

// ‖x‖ at its largest counts accepted steps only.
void StepError::accept() {
  for (Quantity& quantity : quantities_) {
    const Values now = quantity.now();
    quantity.past.push(fields::as_rows(now));
    quantity.largest = std::max(quantity.largest, norm_of(now));
  }
}

fields::State StepError::save() const {
  fields::State state = fields::state_on(field_->mesh());
  for (const Quantity& quantity : quantities_) {
    quantity.past.save_past(quantity.name + " ", state);
    state.numbers["largest " + quantity.name] = {quantity.largest};
  }
  return state;
}

std::string StepError::restore(const fields::State& state) {
  for (Quantity& quantity : quantities_) {
    quantity.past.restore_past(quantity.name + " ", state, fields::as_rows(quantity.now()));
    quantity.largest = state.number_list("largest " + quantity.name).at(0);
  }
  return "";
}

}  // namespace tunica::problems
