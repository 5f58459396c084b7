#include "tunica/multigrid/coarsening/matrix_coarsening.hpp"

#include <Tpetra_RowMatrixTransposer.hpp>

#include "tunica/algebra/static_matrix.hpp"
#include "tunica/base/agreement.hpp"
#include "tunica/base/error.hpp"
#include "tunica/base/rows.hpp"
#include "tunica/base/sort_once.hpp"
#include "tunica/base/trilinos.hpp"

namespace tunica::multigrid {

namespace {

using Neighbours = std::vector<std::vector<GlobalOrdinal>>;  ///< of each own node

void check_nodes(const Map& rows, const Map& nodes, const algebra::DofLayout& numbering) {
  std::string problem;
  for (const GlobalOrdinal number : global_numbers(rows)) {
    const GlobalOrdinal node = number / numbering.dofs();
    if (problem.empty() && !nodes.isNodeGlobalElement(node))
      problem = "The unknown " + std::to_string(number) + " of node " + std::to_string(node) +
                " is without the node's scalar, expected " +
                std::to_string(numbering.merged(1, node)) +
                " on the same rank. Unknowns are numbered " + std::to_string(numbering.dofs()) +
                " * node + i, the scalar last.";
  }
  throw_if_any<Error>(*rows.getComm(), problem);
}

Teuchos::RCP<const CrsGraph> graph_of(Neighbours& neighbours,
                                      const Teuchos::RCP<const Map>& nodes) {
  for (auto& row : neighbours) sort_once(row);
  return algebra::graph_of_rows(neighbours, nodes);
}

/// By local column of M, the position of its node among all nodes of columns, ascending.
struct ColumnNodes {
  std::vector<GlobalOrdinal> nodes;
  std::vector<int> of_column;

  template <class NodeOf>
  ColumnNodes(const Map& columns, const NodeOf& node_of) {
    for (const GlobalOrdinal number : global_numbers(columns)) nodes.push_back(node_of(number));
    const std::vector<GlobalOrdinal> all = nodes;
    sort_once(nodes);
    for (const GlobalOrdinal node : all) of_column.push_back(place_of(node, nodes));
  }
};

/// Appends to each own node those of the columns of the rows of M that are its. Where its rows
/// follow each other each is appended once: they repeat their neighbours a dozen times.
template <class NodeOf>
void append(const CrsMatrix& M, const Map& nodes, const NodeOf& node_of, Neighbours& neighbours) {
  const ColumnNodes columns(*M.getColMap(), node_of);
  std::vector<LocalOrdinal> seen_by(columns.nodes.size(), -1);
  const auto local = M.getLocalMatrixHost();
  for (int i = 0; i < local.numRows(); ++i) {
    const LocalOrdinal own = nodes.getLocalElement(node_of(M.getRowMap()->getGlobalElement(i)));
    const auto row = local.rowConst(i);
    for (int k = 0; k < row.length; ++k) {
      const int column = columns.of_column[row.colidx(k)];
      if (seen_by[column] == own) continue;
      seen_by[column] = own;
      neighbours[own].push_back(columns.nodes[column]);
    }
  }
}

}  // namespace

algebra::Nodes nodes_of(const CrsMatrix& K, const algebra::DofLayout& numbering) {
  const Teuchos::RCP<const Map> nodes = numbering.block_map(*K.getRowMap(), 1);
  check_nodes(*K.getRowMap(), *nodes, numbering);
  // a ~ b where K_ab or K_ba has an entry: first the rows of K, then those of the transposed graph
  // of nodes. The diagonal is there even where K lacks it.
  Neighbours neighbours(n_local(*nodes));
  for (std::size_t a = 0; a < neighbours.size(); ++a)
    neighbours[a].push_back(nodes->getGlobalElement(static_cast<int>(a)));
  const auto node_of = [&](GlobalOrdinal number) { return number / numbering.dofs(); };
  append(K, *nodes, node_of, neighbours);
  const auto one_way = algebra::matrix_on(graph_of(neighbours, nodes));
  Tpetra::RowMatrixTransposer<Scalar, LocalOrdinal, GlobalOrdinal, Node> transposer(one_way);
  const auto itself = [](GlobalOrdinal node) { return node; };
  append(*transposer.createTranspose(), *nodes, itself, neighbours);
  // The numbers themselves: on any ranks the same nodes are picked.
  const auto order = Teuchos::rcp(new Vector(nodes));
  for (const GlobalOrdinal node : global_numbers(*nodes))
    order->replaceGlobalValue(node, static_cast<Scalar>(node));
  return {graph_of(neighbours, nodes), order};
}

// Both blocks stand on the same nodes, so that they are coarsened as one.
Teuchos::RCP<MixedCoarsening> make_coarsening(const CrsMatrix& K, int components) {
  const algebra::DofLayout numbering({components, 1});
  const algebra::Nodes nodes = nodes_of(K, numbering);
  const Map& rows = *K.getRowMap();
  return Teuchos::rcp(new MixedCoarsening(
      algebra::BlockSpace({{"vector", numbering.block_map(rows, 0), components, nodes},
                           {"scalar", numbering.block_map(rows, 1), 1, nodes}})));
}

}  // namespace tunica::multigrid
