#pragma once
#include <vector>

#include "tunica/algebra/block_space.hpp"
#include "tunica/base/tensor.hpp"

namespace tunica::multigrid {

/// Interpolation of a solid's displacements from coarse nodes to finer ones, exact for small rigid
/// motions. A thin wall bends in long waves whose normals turn; means of coarse displacements take
/// a turned wall for a sheared one, which costs as much more energy as it is flatter.
///
///   u_i = Σ_k φ_k u_k + θ_i × (x_i − Σ_k φ_k x_k)
///   θ_i = T⁻¹ Σ_k d_k × u_k,   T = Σ_k (|d_k|² I − d_k d_kᵀ),   d_k = x_k − mean of the x_k
///
///   Σ_k (φ_k − w_k)²/w_k + |Σ_k φ_k (x_k − x_i)|²/(ε h²)  least, with Σ_k φ_k = 1
///
///   k    coarse nodes around i: its own parents and those of its neighbours, the nearest of each
///        direction (those in a thin wall lie above each other by the dozen), and further ones
///        where these lie on a line
///   w_k  weights by distance, ~ 1/(|x_k − x_i|²/h² + 0.05)², of sum 1; h² mean of |x_k − x_i|²
///   φ_k  the same, moved so that linear functions are as good as exact where nodes lie on all
///        sides (moving least squares): a thin wall's stretching along itself is stiff, too
///   θ_i  rotation, fitted by least squares to the displacements of the nodes k
///
/// No unknowns are added: coarse levels have three displacements and a pressure as all others.
/// Where the nodes k lie on a line the rotation about it is left out (pseudo-inverse of T).
/// Iterations with plain means of the parents and the same θ_i: 36 for 25 on a wall with six layers
/// of 15 : 1, with as many entries of the coarse matrix.
struct RigidInterpolation {
  /// By local fine node: where its terms begin; none where the node takes plain means.
  std::vector<std::size_t> start;
  std::vector<GlobalOrdinal> nodes;  ///< coarse nodes of the terms
  std::vector<Mat3> blocks;          ///< u_i = Σ blocks u_node

  bool has(int node) const { return start[node + 1] > start[node]; }
};

/// Input of a rigid interpolation, on one level.
struct RigidSource {
  const CrsGraph& nodes;    ///< of the fine level
  const CrsMatrix& P;       ///< the means: a row per fine node, a column per coarse one
  const CrsMatrix& second;  ///< coarse nodes that are parents of any neighbour of a fine node
  const algebra::NodePlaces& fine;
  const algebra::NodePlaces& coarse;
  const std::vector<int>& coarse_rows;  ///< local fine nodes that are coarse ones as well
  /// 1 at nodes between fields, whose parents are such nodes alone; null: none are.
  Teuchos::RCP<const Vector> fine_between = Teuchos::null, coarse_between = Teuchos::null;
  /// Nodes in the middle of their parents take the means: these are exact for linear functions, and
  /// have a tenth of the entries. A beam of 188,000 unknowns is set up in 1.1 in place of 2.0 s and
  /// takes 8 iterations for 7. Not in flat layers, where more nodes than the parents serve better:
  /// 20 iterations in place of 27 on a tube whose elements are 25 times as wide as thick.
  bool keeps_exact_means = false;
};

/// Does not depend on how nodes are distributed. Collective.
RigidInterpolation rigid_interpolation(const RigidSource& source);

}  // namespace tunica::multigrid
