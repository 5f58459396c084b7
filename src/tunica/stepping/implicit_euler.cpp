#include "tunica/stepping/implicit_euler.hpp"

namespace tunica::stepping {

std::vector<std::string> ImplicitEuler::remembers() const {
  return order_ == 1 ? std::vector<std::string>{} : std::vector<std::string>{"velocity"};
}

double ImplicitEuler::inertia_load(const Timeline& x, int i) const {
  // r = xⁿ⁻¹/Δt² + ẋⁿ⁻¹/Δt
  return rate() * (rate() * x.value()[i] + x[0][i]);
}

void ImplicitEuler::accept(Rows now, Timeline& x) const {
  if (order_ == 2)
    for (std::size_t i = 0; i < now.size(); ++i)
      x[0][i] = rate() * (now[i] - x.value()[i]);  // ẋ = (x − xⁿ⁻¹)/Δt
  x.push(std::move(now));
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
