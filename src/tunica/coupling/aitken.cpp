#include "tunica/coupling/aitken.hpp"

#include <algorithm>

#include "tunica/params/check_order.hpp"

namespace tunica::coupling {

// ω_0 is the first factor; the secant needs two residuals.
Aitken::Aitken(const Teuchos::ParameterList& list, const CommPtr& comm)
    : comm_(comm), first_factor_(list.get<double>("first factor")),
      smallest_factor_(list.get<double>("smallest factor")),
      largest_factor_(list.get<double>("largest factor")),
      restarts_(list.get<std::string>("first factor of a step") == "first factor"),
      factor_(first_factor_) {}

void Aitken::begin_step() {
  // The last factor of a step may be any; a large one would overshoot before Aitken can see it.
  factor_ = restarts_ ? first_factor_ : std::min(factor_, first_factor_);
  is_first_ = true;
}

InterfaceVector Aitken::next(const InterfaceVector& d, const InterfaceVector& residual) {
  const InterfaceVector z = preconditioned(residual);
  if (!is_first_) {
    const InterfaceVector change = difference(z, last_residual_);
    // ω = −(d_k − d_{k−1})ᵀ (z_k − z_{k−1}) / |z_k − z_{k−1}|²
    const double size = inner_product(*comm_, change, change);
    if (size > 0.0) factor_ = -inner_product(*comm_, difference(d, last_d_), change) / size;
    factor_ = std::clamp(factor_, smallest_factor_, largest_factor_);
  }
  is_first_ = false;
  last_d_ = d;
  last_residual_ = z;
  InterfaceVector next_d(d);
  for (std::size_t i = 0; i < d.size(); ++i) next_d[i] += factor_ * z[i];  // d + ω P r
  return next_d;
}

void Aitken::save(fields::State& state) const { state.numbers["factor"] = {factor_}; }

void Aitken::restore(const fields::State& state) { factor_ = state.number_list("factor").at(0); }

params::Table aitken_table() {
  params::Table table("dynamic relaxation, the paper's choice");
  table
      .number("first factor", 1.0, params::Range{0.0, 1.0, true, false}, "1",
              "factor before there are two residuals; without a preconditioner the wall's Newton "
              "method may fail in the second iteration from 0.3 on, and the update is halved")
      .number("smallest factor", 1e-4, params::Range{0.0, 1.0, true, false}, "1", "lower bound")
      .number("largest factor", 2.0, params::Range{0.0, 10.0, true, false}, "1", "upper bound")
      .choice("first factor of a step", "first factor", {"first factor", "last factor"},
              "factor at the start of a time step: the first factor, or the last factor of the "
              "previous step if that is smaller")
      .check([](const Teuchos::ParameterList& list, const std::string& path) {
        params::check_order(list, path, "smallest factor", "largest factor");
        params::check_order(list, path, "first factor", "largest factor");
      });
  return table;
}

}  // namespace tunica::coupling
