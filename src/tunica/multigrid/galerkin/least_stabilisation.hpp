#pragma once
#include "tunica/algebra/dof_layout.hpp"
#include "tunica/base/types.hpp"

namespace tunica::multigrid {

/// Enlarges C of a mixed matrix K = [A B1ᵀ; B2 −C] where it is small beside what it stabilises:
///
///   s_i  = Σ_j B2_ij² / |A_jj|, about the diagonal of B2 diag(A)⁻¹ B1ᵀ
///   f_i  = 1, or σ s_i / C_ii where that is larger
///   C_ij ← ½ (f_i + f_j) C_ij for C_ij < 0, i ≠ j;  C_ii such that rows add up to what they did
///
/// Stabilisations of vectors and scalars of equal order are a Laplacian times h²/ν, with C_ii about
/// s_i. Interpolated to a mesh of twice the width they are a quarter of what that mesh needs, to
/// the next one a sixteenth: scalars oscillate there, and incomplete factors of such matrices grow,
/// by 1000 and more on parts of them. Short time steps and stiff compressible solids have C_ii
/// above 10 s_i, and nothing changes. σ: "least stabilisation". Collective.
void enlarge_stabilisation(CrsMatrix& K, const algebra::DofLayout& numbering, double sigma);

}  // namespace tunica::multigrid
