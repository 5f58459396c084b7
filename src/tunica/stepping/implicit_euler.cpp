#include "tunica/stepping/implicit_euler.hpp"

namespace tunica::stepping {

std::vector<std::string> ImplicitEuler::remembers() const {
  return order_ == 1 ? std::vector<std::string>{} : std::vector<std::string>{"velocity"};
}

Vec3 ImplicitEuler::inertia_load(const History& history, int node) const {
  // r = xⁿ⁻¹/Δt² + ẋⁿ⁻¹/Δt
  return rate() * (rate() * history.value()[node] + history[0][node]);
}

void ImplicitEuler::accept(const std::vector<Vec3>& x, History& history) const {
  if (order_ == 2)
    for (std::size_t a = 0; a < x.size(); ++a)
      history[0][a] = rate() * (x[a] - history.value()[a]);  // ẋ = (x − xⁿ⁻¹)/Δt
  history.value() = x;
}

SchemeEntry implicit_euler_scheme() {
  return {"implicit euler",
          "first order, damps what it does not resolve",
          true,
          "",
          params::Table(),
          [](const Teuchos::ParameterList&, int order) {
            return std::make_unique<ImplicitEuler>(order);
          }};
}

}  // namespace tunica::stepping
