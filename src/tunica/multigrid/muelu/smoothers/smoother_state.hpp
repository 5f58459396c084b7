#pragma once

namespace tunica::multigrid {

/// How a NodalIluSmoother has been set up for its matrix.
struct SmootherState {
  int fill = 0;          ///< levels of fill of the factors
  double shift = 0.0;    ///< by which diagonal blocks are enlarged before the factorisation
  double radius = 0.0;   ///< spectral radius of (L U)⁻¹ K; 0 where it is not measured
  double damping = 1.0;  ///< ω
};

}  // namespace tunica::multigrid
