#pragma once
#include "oracle/mooney_rivlin_energy.hpp"
#include "oracle/samples.hpp"
#include "tunica/materials/frame.hpp"

namespace tunica::oracle {

/// Matrix and two families of fibres from the invariants as [LY1] and [GOH] define them.
struct HolzapfelEnergy {
  double c10, c01, k1, k2, degrees, dispersion;
  materials::Frame frame;

  /// κ_d (J1 − 3) + (1 − 3κ_d)(J_i − 1) of the family on one side of the circumference.
  template <class S>
  S fibre_strain(const Mat<S>& C, int side) const {
    const double angle = side * degrees * std::acos(-1.0) / 180.0;
    S I4 = 0.0;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        I4 += C[i][j] *
              (std::cos(angle) * frame.circumferential[i] + std::sin(angle) * frame.axial[i]) *
              (std::cos(angle) * frame.circumferential[j] + std::sin(angle) * frame.axial[j]);
    const S log_I3 = log(determinant(C));
    const S scale = exp(S(-1.0 / 3.0 * log_I3));
    const S I1 = C[0][0] + C[1][1] + C[2][2];
    return dispersion * (I1 * scale - 3.0) + (1.0 - 3.0 * dispersion) * (I4 * scale - 1.0);
  }

  template <class S>
  S operator()(const Mat<S>& C) const {
    S Psi = MooneyRivlinEnergy{c10, c01}(C);
    for (const int side : {1, -1}) {
      const S e = fibre_strain(C, side);
      if (e > 0.0) Psi += k1 / (2.0 * k2) * (exp(S(k2 * e * e)) - 1.0);
    }
    return Psi;
  }
};

/// A frame without relation to the coordinates.
inline materials::Frame random_frame(Samples& samples) {
  const Mat3 Q = samples.rotation();
  return {Q[0], Q[1], Q[2]};
}

}  // namespace tunica::oracle
