#include "tunica/stepping/trapezoidal.hpp"

#include <stdexcept>

#include "tunica/stepping/implicit_euler.hpp"
#include "tunica/stepping/newmark.hpp"

namespace tunica::stepping {

Vec3 Trapezoidal::past(const History& history, int place) const {
  const Vec3& last = history.value()[place];
  return is_eulers() ? last : last + 1.0 / rate() * history[0][place];
}

Vec3 Trapezoidal::prediction(const History& history, int place) const {
  return history.value()[place] + step_size() * history[0][place];
}

Vec3 Trapezoidal::inertia_load(const History&, int) const {
  throw std::logic_error("Trapezoidal: an equation of first order has no second derivative");
}

void Trapezoidal::accept(const std::vector<Vec3>& x, History& history) const {
  for (std::size_t k = 0; k < x.size(); ++k)
    history[0][k] = rate() * (x[k] - past(history, static_cast<int>(k)));  // ẋ = (x − x̃)/Δt_e
  history.value() = x;
}

ErrorFormula Trapezoidal::value_error(const StepSizes& sizes) const {
  return is_eulers() ? ImplicitEuler(1).value_error(sizes)
                     : error_of_third_derivative(-1.0 / 12.0, sizes);
}

SchemeEntry trapezoidal_scheme() {
  return {"trapezoidal",
          "second order, takes no energy out and damps nothing: for smooth loads",
          true,
          "",
          params::Table(),
          [](const Teuchos::ParameterList&, int order) -> std::unique_ptr<TimeScheme> {
            if (order == 1) return std::make_unique<Trapezoidal>();
            return std::make_unique<Newmark>(0.25, 0.5, Newmark::Start::implicit_euler);
          }};
}

}  // namespace tunica::stepping
