#pragma once
#include "tunica/algebra/block_matrix.hpp"
#include "tunica/base/trilinos.hpp"
#include "unit/multigrid/grid.hpp"

namespace tunica::test {

/// The nodes of a graph in the order of their numbers.
inline algebra::Nodes nodes_of(const Teuchos::RCP<const CrsGraph>& graph) {
  const auto order = Teuchos::rcp(new Vector(graph->getRowMap()));
  for (const GlobalOrdinal row : global_numbers(*graph->getRowMap()))
    order->replaceGlobalValue(row, static_cast<Scalar>(row));
  return {graph, order};
}

/// A block of vectors A on nodes, a block of scalars C on nodes of its own; nothing between them.
inline algebra::BlockMatrix two_blocks(const Teuchos::RCP<CrsMatrix>& A, int components,
                                       const algebra::Nodes& nodes,
                                       const Teuchos::RCP<CrsMatrix>& C) {
  const algebra::Nodes own = nodes.graph == C->getCrsGraph() ? nodes : nodes_of(C->getCrsGraph());
  algebra::BlockMatrix K(std::make_shared<const algebra::BlockSpace>(std::vector<algebra::Block>{
      {"vector", A->getRowMap(), components, nodes}, {"scalar", C->getRowMap(), 1, own}}));
  K.set(0, 0, A);
  K.set(1, 1, C);
  return K;
}

/// The diagonal blocks, Laplacians, of a system on a grid.
inline algebra::BlockMatrix blocks_on(const Grid& grid, const CommPtr& comm = world(),
                                      int components = 3) {
  const auto C = grid.laplacian(comm);
  return two_blocks(grid.laplacian(comm, components), components, nodes_of(C->getCrsGraph()), C);
}

}  // namespace tunica::test
