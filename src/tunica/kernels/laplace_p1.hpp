#pragma once
#include "tunica/kernels/tet4.hpp"

namespace tunica::kernels {

/// K[a][b] = ∫ ∇N_a·∇N_b dV = V ∇N_a·∇N_b [mm], the same for each component of a vector.
/// Harmonic mesh motion solves with it on the undeformed mesh.
std::array<std::array<double, 4>, 4> laplace_p1(const Tet4& T);

/// The matrix of a triangle: ∫ ∇N_a·∇N_b dA = e_a·e_b / (4 A), e_a the edge that faces corner a
/// [1].
std::array<std::array<double, 3>, 3> laplace_p1(const std::array<Vec3, 3>& x);

}  // namespace tunica::kernels
