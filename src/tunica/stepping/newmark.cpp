#include "tunica/stepping/newmark.hpp"

#include "tunica/stepping/implicit_euler.hpp"

namespace tunica::stepping {

Newmark::Newmark(const Teuchos::ParameterList& list)
    : Newmark(list.get<double>("beta"), list.get<double>("gamma"),
              list.get<std::string>("start") == "rest" ? Start::rest : Start::implicit_euler) {}

double Newmark::momentum(const Timeline& x, int i) const {
  const double of_velocity = 1.0 / (beta() * step_size()) * x[0][i];
  if (is_eulers()) return of_velocity;
  return of_velocity + (1.0 - 2.0 * beta_) / (2.0 * beta_) * x[1][i];
}

double Newmark::inertia_load(const Timeline& x, int i) const {
  const double dt = step_size();
  return 1.0 / (beta() * dt * dt) * x.value()[i] + momentum(x, i);
}

double Newmark::past(const Timeline& x, int i) const {
  // v = vⁿ⁻¹ + (1 − γ)Δt aⁿ⁻¹ + γΔt a, with a = (d − dⁿ⁻¹)/(βΔt²) − momentum
  const double dt = step_size();
  const double known = x[0][i] + dt * ((1.0 - gamma()) * x[1][i]) - gamma() * dt * momentum(x, i);
  return x.value()[i] - 1.0 / rate() * known;
}

void Newmark::accept(Rows now, Timeline& x) const {
  const double dt = step_size();
  for (std::size_t i = 0; i < now.size(); ++i) {
    const double a =
        1.0 / (beta() * dt * dt) * (now[i] - x.value()[i]) - momentum(x, static_cast<int>(i));
    x[0][i] = x[0][i] + dt * ((1.0 - gamma()) * x[1][i] + gamma() * a);
    x[1][i] = a;
  }
  x.push(std::move(now));
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
              "first step, and first step after a kink of the loads: with the earlier acceleration "
              "(rest, the paper's choice), or by a step of implicit Euler (implicit euler), which "
              "finds the acceleration of the load and so keeps second order if the load is applied "
              "as a step");
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
