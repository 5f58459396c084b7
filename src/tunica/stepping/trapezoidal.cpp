#include "tunica/stepping/trapezoidal.hpp"

#include <stdexcept>

#include "tunica/stepping/implicit_euler.hpp"
#include "tunica/stepping/newmark.hpp"

namespace tunica::stepping {

double Trapezoidal::past(const Timeline& x, int i) const {
  const double last = x.value()[i];
  return is_eulers() ? last : last + 1.0 / rate() * x[0][i];
}

double Trapezoidal::prediction(const Timeline& x, int i) const {
  return x.value()[i] + step_size() * x[0][i];
}

double Trapezoidal::inertia_load(const Timeline&, int) const {
  throw std::logic_error("Trapezoidal: an equation of first order has no second derivative");
}

void Trapezoidal::accept(Rows now, Timeline& x) const {
  for (std::size_t i = 0; i < now.size(); ++i)
    x[0][i] = rate() * (now[i] - past(x, static_cast<int>(i)));  // ẋ = (x − x̃)/Δt_e
  x.push(std::move(now));
}

ErrorFormula Trapezoidal::value_error(const StepSizes& sizes) const {
  return is_eulers() ? ImplicitEuler(1).value_error(sizes)
                     : error_of_third_derivative(-1.0 / 12.0, sizes);
}

SchemeEntry trapezoidal_scheme() {
  return {"trapezoidal",
          "second order, without dissipation and damping: for smooth loads",
          true,
          "",
          params::Table(),
          [](const Teuchos::ParameterList&, int order) -> std::unique_ptr<TimeScheme> {
            if (order == 1) return std::make_unique<Trapezoidal>();
            return std::make_unique<Newmark>(0.25, 0.5, Newmark::Start::implicit_euler);
          }};
}

}  // namespace tunica::stepping
