#pragma once
#include "oracle/algebra.hpp"
#include "oracle/samples.hpp"

namespace tunica::oracle {

/// C = I + 2E for Voigt strain E with engineering shears.
template <class S>
Mat<S> cauchy_green(const std::array<S, 6>& E) {
  return {{{S(1.0 + 2.0 * E[0]), E[3], E[5]},
           {E[3], S(1.0 + 2.0 * E[1]), E[4]},
           {E[5], E[4], S(1.0 + 2.0 * E[2])}}};
}

/// The strain of a deformation gradient of some tens of per cent.
inline std::array<double, 6> random_strain(Samples& samples) {
  Mat<double> F = {{samples.vector(0.4), samples.vector(0.4), samples.vector(0.4)}};
  for (int i = 0; i < 3; ++i) F[i][i] += 1.2;
  const Mat<double> C = gram(F);
  return {0.5 * (C[0][0] - 1), 0.5 * (C[1][1] - 1), 0.5 * (C[2][2] - 1), C[0][1], C[1][2], C[2][0]};
}

/// C in the order of Sym3.
inline Sym3 voigt(const std::array<double, 6>& E) {
  return {1 + 2 * E[0], 1 + 2 * E[1], 1 + 2 * E[2], E[3], E[4], E[5]};
}

}  // namespace tunica::oracle
