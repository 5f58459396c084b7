#pragma once
#include "tunica/algebra/block_space.hpp"
#include "tunica/systems/matrix_files.hpp"
#include "tunica/systems/matrix_rows.hpp"
#include "tunica/systems/node_graph.hpp"

namespace tunica::systems {

/// Rows of which each rank has a portion, and the ranks that they are dealt to.
struct Deal {
  /// numbers, ranks: of each row of the portion. Collective.
  Deal(std::vector<GlobalOrdinal> numbers, std::vector<int> ranks, const CommPtr& comm);

  std::vector<GlobalOrdinal> numbers;
  std::vector<int> ranks;
  Teuchos::RCP<const Map> portions, dealt;  ///< as the numbers are; ascending
};

/// Takes the rows, so that nobody has them twice. Collective.
Teuchos::RCP<CrsMatrix> dealt(MatrixRows A, const Deal& rows, const Deal& columns);
/// values: of the rows of the portion. Collective.
Teuchos::RCP<Vector> dealt(const std::vector<double>& values, const Deal& rows);
/// Without the nodes that are not even their own neighbours. ranks: of each node of the portion.
/// Collective.
algebra::Nodes dealt(NodeGraph graph, const std::vector<int>& ranks);
/// Columns of coordinates, a row per node of the portion, taken to the ranks of the nodes: those of
/// a solid. Further nodes have none. Collective.
algebra::NodePlaces dealt(const std::vector<ColumnRows>& coordinates, const algebra::Nodes& nodes);

}  // namespace tunica::systems
