#include "tunica/stepping/newmark.hpp"

#include "tunica/stepping/implicit_euler.hpp"

namespace tunica::stepping {

Newmark::Newmark(const Teuchos::ParameterList& list)
    : Newmark(list.get<double>("beta"), list.get<double>("gamma"),
              list.get<std::string>("start") == "rest" ? Start::rest : Start::implicit_euler) {}

Vec3 Newmark::momentum(const History& history, int node) const {
  const Vec3 of_velocity = 1.0 / (beta() * step_size()) * history[0][node];
  if (is_eulers()) return of_velocity;
  return of_velocity + (1.0 - 2.0 * beta_) / (2.0 * beta_) * history[1][node];
}

Vec3 Newmark::inertia_load(const History& history, int node) const {
  const double dt = step_size();
  return 1.0 / (beta() * dt * dt) * history.value()[node] + momentum(history, node);
}

Vec3 Newmark::past(const History& history, int node) const {
  // v = vⁿ⁻¹ + (1 − γ)Δt aⁿ⁻¹ + γΔt a, with a = (d − dⁿ⁻¹)/(βΔt²) − momentum
  const double dt = step_size();
  const Vec3 known = history[0][node] + dt * ((1.0 - gamma()) * history[1][node]) -
                     gamma() * dt * momentum(history, node);
  return history.value()[node] - 1.0 / rate() * known;
}

void Newmark::accept(const std::vector<Vec3>& x, History& history) const {
  const double dt = step_size();
  for (std::size_t k = 0; k < x.size(); ++k) {
    const int node = static_cast<int>(k);
    const Vec3 a = 1.0 / (beta() * dt * dt) * (x[k] - history.value()[k]) - momentum(history, node);
    history[0][k] = history[0][k] + dt * ((1.0 - gamma()) * history[1][k] + gamma() * a);
    history[1][k] = a;
  }
  history.value() = x;
}

ErrorFormula Newmark::value_error(const StepSizes& sizes) const {
  if (is_eulers()) return ImplicitEuler(2).value_error(sizes);
  return error_of_third_derivative(1.0 / 6.0 - beta_, sizes);
}

ErrorFormula Newmark::velocity_error(const StepSizes& sizes) const {
  if (is_eulers()) return ImplicitEuler(2).velocity_error(sizes);
  if (order() == 2) return error_of_third_derivative(-1.0 / 12.0, sizes);
  // (½ − γ) h² of the second derivative, of which v − vᵖ has h (h + h₁)/2
  const StepSizes all = without_gaps(sizes);
  return {1, (1.0 - 2.0 * gamma_) * all.now / (all.now + all.last)};
}

SchemeEntry newmark_scheme() {
  params::Table table("Newmark's time integration of the wall.");
  table
      .number("beta", 0.625, params::Range{0.0, 1.0, true, false}, "1",
              "β; more than 0.5 keeps the pressure free of oscillations in time")
      .number("gamma", 1.0, params::between(0.5, 1.0), "1", "γ; 1 is the first-order scheme")
      .choice("start", "rest", {"rest", "implicit euler"},
              "of the first step, and behind a kink of the loads: with the acceleration of before "
              "(rest, the paper's), or by a step of implicit euler, which finds that of the load "
              "and so keeps second order where the load is there at once");
  return {"newmark",
          "the paper's for the wall, with the keys below",
          false,
          "Newmark",
          table,
          [](const Teuchos::ParameterList& wall, int) {
            return std::make_unique<Newmark>(wall.sublist("Newmark"));
          }};
}

}  // namespace tunica::stepping
