#pragma once
#include "tunica/algebra/block_matrix.hpp"

namespace tunica::foreign {

// What the values of a matrix K = [A B1ᵀ; B2 −C] tell of where it comes from. All are collective.

/// Parts of the scalar rows with entries in B2.
struct Pivots {
  double of_c = 0.0;    ///< that have a diagonal in C
  double of_own = 0.0;  ///< that have enough of their pivot from their own node
};

/// With vectors c, b_i = Σ_c B2_ic² / |A_cc| is the pivot of scalar i without C.
Pivots find_pivots(const algebra::BlockMatrix& K);

/// As a mass matrix: ten conjugate gradients with the diagonal gain a factor 100.
bool is_near_its_diagonal(const CrsMatrix& A);

/// A mass with little of a derivative, as of a short time step: in most of the rows with neighbours
/// the entries of its own component add up to 2.2 of the diagonal or more.
bool is_mostly_mass(const CrsMatrix& A, int components);

/// Little convection: A y and Aᵀ y of a y without pattern differ by a hundredth at most.
bool is_nearly_symmetric(const CrsMatrix& A);

/// Whether A is a Laplacian of each component by itself, with a mild coefficient, or as plain as
/// one. Means of coarse vectors then serve; where components are coupled, as in elasticity, or the
/// coefficient jumps, cycles by Braess and Sarazin contract by 0.8 and less.
bool is_plain(const algebra::BlockMatrix& K);

/// Of elements as Taylor and Hood's, with several times as many vectors as scalars, C is small, and
/// the incomplete factors of the nodes grow.
bool are_scalars_few(const algebra::BlockMatrix& K);

}  // namespace tunica::foreign
