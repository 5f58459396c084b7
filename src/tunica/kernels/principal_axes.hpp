#pragma once
#include "tunica/base/tensor.hpp"

namespace tunica::kernels {

/// A = Σ_k values[k] directions[k] ⊗ directions[k], the largest value first.
struct PrincipalAxes {
  Vec3 values;
  std::array<Vec3, 3> directions;  ///< orthonormal
};

/// Eigenvalues and eigenvectors of a symmetric tensor by Jacobi's rotations, to round-off.
PrincipalAxes principal_axes(const Sym3& A);

/// The values alone: principal stresses, squares of the principal stretches.
inline Vec3 principal_values(const Sym3& A) { return principal_axes(A).values; }

}  // namespace tunica::kernels
