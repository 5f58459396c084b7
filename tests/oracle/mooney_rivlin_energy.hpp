#pragma once
#include "oracle/algebra.hpp"

namespace tunica::oracle {

/// Ψ' = c10/2 (J1 − 3) + c01/2 (J2 − 3) from the invariants as [LY1] defines them.
struct MooneyRivlinEnergy {
  double c10;
  double c01;

  template <class S>
  S operator()(const Mat<S>& C) const {
    const S I1 = C[0][0] + C[1][1] + C[2][2];
    S CC = 0.0;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) CC += C[i][j] * C[i][j];
    const S I2 = 0.5 * (I1 * I1 - CC);
    const S log_I3 = log(determinant(C));
    const S J1 = I1 * exp(S(-1.0 / 3.0 * log_I3));
    const S J2 = I2 * exp(S(-2.0 / 3.0 * log_I3));
    return 0.5 * c10 * (J1 - 3.0) + 0.5 * c01 * (J2 - 3.0);
  }
};

}  // namespace tunica::oracle
