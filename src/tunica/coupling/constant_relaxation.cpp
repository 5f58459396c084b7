#include "tunica/coupling/constant_relaxation.hpp"

namespace tunica::coupling {

InterfaceVector ConstantRelaxation::next(const InterfaceVector& d,
                                         const InterfaceVector& residual) {
  const InterfaceVector z = preconditioned(residual);
  InterfaceVector next_d(d);
  for (std::size_t i = 0; i < d.size(); ++i) next_d[i] += factor_ * z[i];  // d + ω P r
  return next_d;
}

params::Table constant_relaxation_table() {
  params::Table table("the same relaxation factor in every iteration");
  table.number("factor", 0.5, params::Range{0.0, 2.0, true, false}, "1",
               "relaxation factor; with blood and soft walls more than 0.02 diverges without a "
               "preconditioner");
  return table;
}

}  // namespace tunica::coupling
