#pragma once
#include <vector>

#include "tunica/algebra/block_space.hpp"
#include "tunica/base/tensor.hpp"

namespace tunica::multigrid {

/// Interpolation of a solid's displacements from coarse nodes to finer ones, exact for small rigid
/// motions. A thin wall bends in long waves whose normals turn; means of coarse displacements take
/// a turned wall for a sheared one, which costs as much more energy as it is flatter.
///
///   u_i = 1/n_i Σ_j u_j + θ_i × (x_i − x̄_i),   x̄_i = 1/n_i Σ_j x_j   (j: parents of i)
///   θ_i = T⁻¹ Σ_k d_k × u_k,   T = Σ_k (|d_k|² I − d_k d_kᵀ),   d_k = x_k − mean of the x_k
///
///   u_j  displacement of a coarse node           x  place of a node
///   θ_i  rotation, fitted by least squares       k  the parents of i, and further coarse nodes,
///        to displacements of the nodes k            the nearest first, until they span a plane
///
/// A node keeps its parents for the translation: those further nodes only tell the rotation. No
/// unknowns are added: coarse levels have three displacements and a pressure as all others.
/// Where the nodes k lie on a line the rotation about it is left out (pseudo-inverse of T).
struct RigidInterpolation {
  /// By local fine node: where its terms begin; none where the node takes plain means.
  std::vector<std::size_t> start;
  std::vector<GlobalOrdinal> nodes;  ///< coarse nodes of the terms
  std::vector<Mat3> blocks;          ///< u_i = Σ blocks u_node

  bool has(int node) const { return start[node + 1] > start[node]; }
};

/// What it is made of, on one level.
struct RigidSource {
  const CrsMatrix& P;      ///< the means: a row per fine node, a column per coarse one
  const CrsGraph& second;  ///< coarse nodes that are parents of any neighbour of a fine node
  const algebra::NodePlaces& fine;
  const algebra::NodePlaces& coarse;
  const std::vector<int>& coarse_rows;  ///< local fine nodes that are coarse ones as well
  /// 1 at nodes between fields, whose parents are such nodes alone; null: none are.
  Teuchos::RCP<const Vector> fine_between, coarse_between;
};

/// Does not depend on how nodes are distributed. Collective.
RigidInterpolation rigid_interpolation(const RigidSource& source);

}  // namespace tunica::multigrid
