#pragma once

namespace tunica::linear {

/// Registers the block LU preconditioners with Teko, once per program. For the block system
/// K = [A B1ᵀ; B2 −C] and approximations Ã, S̃ of A and of S = C + B2 A⁻¹ B1ᵀ they are
///
///   LU Upper   P_R = [Ã  B1ᵀ]   LU Lower   P_L = [Ã    0]   LU Full   P_F = [I       ] P_R
///                    [    −S̃]                    [B2  −S̃]                   [B2 Ã⁻¹ I]
///
/// Keys of a library entry beside "Type": "Inverse Velocity Type", the library's inverse for Ã,
/// and those of schur.hpp.
///
/// Source: [LY1] eq:lufac, eq:rpre, eq:lpre.
void register_lu_strategies();

}  // namespace tunica::linear
