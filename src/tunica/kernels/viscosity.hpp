#pragma once
#include "tunica/base/pack.hpp"
#include "tunica/base/tensor.hpp"
#include "tunica/materials/viscosity_law.hpp"

namespace tunica::kernels {

/// γ̇² = 2 ε:ε = ½ |G + Gᵀ|² of a velocity with the gradient G [1/ms²].
template <class Real>
Real squared_shear_rate(const Mat3Of<Real>& G) {
  Real twice = 0.0;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) twice += (G[i][j] + G[j][i]) * (G[i][j] + G[j][i]);
  return 0.5 * twice;
}

/// Where the velocity has the gradient G.
inline materials::Viscosity viscosity_at(const materials::ViscosityLaw& law, const Mat3& G) {
  if (law.is_constant()) return {law.reference(), 0.0};
  return law.at(squared_shear_rate(G));
}
inline materials::ViscosityOf<Pack> viscosity_at(const materials::ViscosityLaw& law,
                                                 const Mat3Of<Pack>& G) {
  if (law.is_constant()) return {law.reference(), 0.0};
  const Pack rate = squared_shear_rate(G);
  materials::ViscosityOf<Pack> mu{};
  for (int lane = 0; lane < Pack::size; ++lane) {
    const materials::Viscosity of_one = law.at(rate[lane]);
    mu.value.set(lane, of_one.value);
    mu.slope.set(lane, of_one.slope);
  }
  return mu;
}

}  // namespace tunica::kernels
