#pragma once
#include <array>

#include "tunica/kernels/tet4.hpp"

namespace tunica::kernels {

/// Rows and columns 3 a + i of the displacements at the four nodes.
using ElasticElement = std::array<std::array<double, 12>, 12>;

/// Stiffness of a linear elastic tetrahedron of Young's modulus E [kPa] and Poisson's ratio ν:
///
///   K[a i][b j] = V (λ g_a[i] g_b[j] + μ g_a[j] g_b[i] + μ g_a·g_b δ_ij),  g_a = ∇N_a
///
/// with μ = E/(2(1 + ν)) and λ = E ν/((1 + ν)(1 − 2ν)), Hooke's law [kPa mm].
ElasticElement elastic_p1(const Tet4& T, double young, double poisson);

using ElasticTriangle = std::array<std::array<double, 9>, 9>;

/// The same of a triangle x of unit thickness, with its area for V and g_a within its plane: plane
/// strain of displacements in the plane, which those across it do not see. These are harmonic,
/// K[a][b] = A μ g_a·g_b [kPa].
ElasticTriangle elastic_p1(const std::array<Vec3, 3>& x, double young, double poisson);

}  // namespace tunica::kernels
