#pragma once
#include "tunica/kernels/principal_axes.hpp"
#include "tunica/kernels/tet4.hpp"
#include "tunica/materials/wall_law.hpp"

namespace tunica::kernels {

/// Cauchy stress σ = J⁻¹ F S' Fᵀ − p I of one element at its mean pressure [kPa].
Sym3 cauchy_stress(const Tet4& T, const std::array<Vec3, 4>& d, const std::array<double, 4>& p,
                   const materials::WallLaw& law, const materials::Frame& frame = {},
                   const materials::Past& past = {});

/// √(3/2 dev σ : dev σ) [kPa].
double von_mises(const Sym3& sigma);

}  // namespace tunica::kernels
