#pragma once
#include <vector>

#include "tunica/fields/field_mesh.hpp"

namespace tunica::assembly {

/// Values at nodes from values that are constant on elements, second order up to the boundary.
///
/// Around each node the values at the centroids are fitted by a linear function, which is taken at
/// the node. The patch has two rings of elements:
///
///   min Σ_e w_e |v(x_e) − v_e|²,   v linear,    w_e = Σ_b n_ab over the vertices b of e
///
///   n_ab  how many elements have both nodes a and b: elements near a count more
///
/// One ring does not determine a slope: at corners all its centroids may lie in a plane. With the
/// weighted mean x̄ and covariance C = Q Λ Qᵀ of the centroids the fit is
///
///   v(x_a) = v̄ + Σ_k f_k d_k q_kᵀ cov(x, v)/λ_k,   d = Qᵀ(x_a − x̄),  f_k = min(1, 3 √λ_k/|d_k|)
///
/// The factor f bounds each term by three standard deviations of the values, however flat the
/// patch. It is 1 in regular meshes with two elements over the thickness and more; across one
/// element the centroids, at 1/4, 1/2 and 3/4, say little of the slope: |d|/√λ is 4 to 6 there.
///
/// On a fields::SplitMesh patches end between its parts, and what jumps there stays apart.
/// Results do not depend on the number of ranks but for round-off. Source: [ZZ92].
/// Deviation: values everywhere from all elements of the patch, at nodes of the boundary as well.
class PatchRecovery {
public:
  /// mesh must outlive the object. Collective.
  explicit PatchRecovery(const fields::FieldMesh& mesh);

  const fields::FieldMesh& mesh() const { return *mesh_; }

  /// values: so many of each local element, element by element. Those of owned nodes, node by
  /// node. Collective.
  std::vector<double> at_owned_nodes(int components, const std::vector<double>& values) const;
  /// Those of owned and ghost nodes. Collective.
  std::vector<double> at_nodes(int components, const std::vector<double>& values) const;

private:
  /// Components from first to last of so many.
  void add_at_owned_nodes(int components, int first, int last, const std::vector<double>& values,
                          std::vector<double>& nodal) const;

  const fields::FieldMesh* mesh_;
  std::vector<double> constant_;  ///< per owned node: weight of each element of the patch, and of
  std::vector<Vec3> slope_;       ///< its centroid from the node [1/mm]
};

}  // namespace tunica::assembly
