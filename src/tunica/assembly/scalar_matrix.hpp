#pragma once
#include <array>

#include "tunica/assembly/gather.hpp"
#include "tunica/fields/block_operator.hpp"
#include "tunica/kernels/laplace_p1.hpp"

namespace tunica::assembly {

using ScalarElement = std::array<std::array<double, 4>, 4>;

/// A scalar matrix on the node graph from its element matrices, element(e) for the local tet e.
/// Rows and columns of fixed nodes (one flag per local node) keep only their diagonal.
template <class Element>
Teuchos::RCP<CrsMatrix> scalar_matrix(const fields::FieldMesh& mesh, const fields::NodeGraph& graph,
                                      Element element, const std::vector<char>& is_fixed) {
  const Teuchos::RCP<CrsMatrix> matrix = fields::make_matrix(graph, mesh, 1, 1);
  matrix->resumeFill();
  {
    const auto values = matrix->getLocalMatrixHost().values;
    for (std::size_t e = 0; e < mesh.tets.size(); ++e) {
      const ScalarElement K = element(e);
      const auto& nodes = mesh.tets[e];
      for (int a = 0; a < 4; ++a) {
        if (nodes[a] >= mesh.n_owned) continue;
        for (int b = 0; b < 4; ++b)
          if (a == b || !(is_fixed[nodes[a]] || is_fixed[nodes[b]]))
            values(graph.row_start[nodes[a]] + graph.position[e][4 * a + b]) += K[a][b];
      }
    }
  }
  matrix->fillComplete(mesh.node_map, mesh.node_map);
  return matrix;
}

/// ∫ ∇N_a·∇N_b on the mesh with its local nodes at these positions.
inline Teuchos::RCP<CrsMatrix> laplacian(const fields::FieldMesh& mesh,
                                         const std::vector<Vec3>& positions,
                                         const fields::NodeGraph& graph,
                                         const std::vector<char>& is_fixed) {
  const auto element = [&](std::size_t e) {
    return kernels::laplace_p1(kernels::make_tet4(gather(positions, mesh.tets[e])));
  };
  return scalar_matrix(mesh, graph, element, is_fixed);
}

/// factor ∫ N_a N_b on one element.
inline ScalarElement mass_element(double volume, double factor) {
  ScalarElement M;
  for (int a = 0; a < 4; ++a)
    for (int b = 0; b < 4; ++b) M[a][b] = factor * volume / 20.0 * (a == b ? 2.0 : 1.0);
  return M;
}

}  // namespace tunica::assembly
