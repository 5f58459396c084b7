#pragma once
#include "tunica/kernels/tet4.hpp"

namespace tunica::kernels {

/// K[a][b] = ∫ ∇N_a·∇N_b dV = V ∇N_a·∇N_b [mm], the same for each component of a vector.
/// Harmonic mesh motion solves with it on the undeformed mesh.
std::array<std::array<double, 4>, 4> laplace_p1(const Tet4& T);

}  // namespace tunica::kernels
