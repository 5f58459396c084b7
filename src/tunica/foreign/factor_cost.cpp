#include "tunica/foreign/factor_cost.hpp"

#include "tunica/algebra/static_matrix.hpp"
#include "tunica/base/map_of.hpp"
#include "tunica/base/sort_once.hpp"
#include "tunica/base/trilinos.hpp"
#include "tunica/linear/direct/direct_factor.hpp"

namespace tunica::foreign {

namespace {

/// Adds the nodes of the columns of a block's rows to the neighbours of the rows' nodes.
///   components, first: unknowns of a node, and what is added to its number; of rows and columns
void add_neighbours(const CrsMatrix& block, const Map& nodes, int row_components,
                    GlobalOrdinal first_row, int column_components, GlobalOrdinal first_column,
                    std::vector<std::vector<GlobalOrdinal>>& neighbours) {
  const auto local = block.getLocalMatrixHost();
  for (int r = 0; r < local.numRows(); ++r) {
    const GlobalOrdinal node = block.getRowMap()->getGlobalElement(r) / row_components + first_row;
    std::vector<GlobalOrdinal>& found = neighbours[nodes.getLocalElement(node)];
    const auto row = local.rowConst(r);
    for (int k = 0; k < row.length; ++k)
      found.push_back(block.getColMap()->getGlobalElement(row.colidx(k)) / column_components +
                      first_column);
  }
}

/// A node for each of the vectors' and, behind them, of the scalars'; neighbours by all blocks.
Teuchos::RCP<const CrsGraph> graph_of_all(const algebra::BlockMatrix& K) {
  const algebra::BlockSpace& space = *K.space();
  std::vector<GlobalOrdinal> first = {0}, numbers;
  for (int b = 0; b < space.n_blocks(); ++b) {
    const Map& unknowns = *space[b].map;
    for (const GlobalOrdinal unknown : global_numbers(unknowns))
      numbers.push_back(first[b] + unknown / space[b].components);
    first.push_back(first[b] + unknowns.getMaxAllGlobalIndex() / space[b].components + 1);
  }
  sort_once(numbers);
  const Teuchos::RCP<const Map> nodes = map_of(numbers, space.comm());
  std::vector<std::vector<GlobalOrdinal>> neighbours(numbers.size());
  for (std::size_t a = 0; a < numbers.size(); ++a) neighbours[a] = {numbers[a]};
  for (int i = 0; i < K.n_blocks(); ++i)
    for (int j = 0; j < K.n_blocks(); ++j)
      if (!K(i, j).is_null())
        add_neighbours(*K(i, j), *nodes, space[i].components, first[i], space[j].components,
                       first[j], neighbours);
  for (std::vector<GlobalOrdinal>& found : neighbours) sort_once(found);
  return algebra::graph_of_rows(neighbours, nodes);
}

double entries_of(const algebra::BlockMatrix& K) {
  double entries = 0.0;
  for (int i = 0; i < K.n_blocks(); ++i)
    for (int j = 0; j < K.n_blocks(); ++j)
      if (!K(i, j).is_null()) entries += static_cast<double>(K(i, j)->getGlobalNumEntries());
  return entries;
}

double operations_by(const Teuchos::RCP<const CrsGraph>& graph, const algebra::BlockMatrix& K,
                     double enough) {
  const double b =
      static_cast<double>(K.n_unknowns()) / static_cast<double>(graph->getGlobalNumRows());
  const double scale = b * b * b / entries_of(K);
  return scale * linear::factor_operations(graph, enough / scale);
}

bool have_scalars_own_nodes(const algebra::BlockSpace& space) {
  return space.n_blocks() > 1 && !space[1].nodes.graph.is_null() &&
         space[1].nodes.graph != space[0].nodes.graph;
}

/// Times what may be. Beyond the first an estimate by vectors leaves no doubt, nor below the second
/// where scalars have nodes of their own.
constexpr double too_many = 2.0, few = 0.5;

}  // namespace

double operations_by_vectors(const algebra::BlockMatrix& K, double enough) {
  const Teuchos::RCP<const CrsGraph>& graph = (*K.space())[0].nodes.graph;
  return graph.is_null() ? 0.0 : operations_by(graph, K, enough);
}

double operations_by_all_nodes(const algebra::BlockMatrix& K, double enough) {
  return operations_by(graph_of_all(K), K, enough);
}

bool is_factoring_dear(const algebra::BlockMatrix& K, double by_vectors, double most) {
  if (by_vectors > too_many * most) return true;
  return have_scalars_own_nodes(*K.space()) && by_vectors > few * most &&
         operations_by_all_nodes(K, most) > most;
}

}  // namespace tunica::foreign
