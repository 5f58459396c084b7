#include "tunica/multigrid/coarsening/nodal_coarsening.hpp"

#include <TpetraExt_MatrixMatrix.hpp>

#include "tunica/algebra/independent_set.hpp"
#include "tunica/algebra/sparse_product.hpp"
#include "tunica/base/trilinos.hpp"

namespace tunica::multigrid {

namespace {

/// Numbers the nodes of the set rank by rank; the number at a ghost is that of its owner, and
/// -1 outside the set.
struct CoarseNumbers {
  Teuchos::RCP<const Map> map;
  std::vector<int> rows;  ///< local, of the nodes in the set
  std::vector<GlobalOrdinal> of_column;

  CoarseNumbers(const CrsMatrix& nodes, const std::vector<char>& is_coarse) {
    const Map& own_nodes = *nodes.getRowMap();
    for (int i = 0; i < static_cast<int>(n_local(own_nodes)); ++i)
      if (is_coarse[nodes.getColMap()->getLocalElement(own_nodes.getGlobalElement(i))])
        rows.push_back(i);
    const auto unknown = Teuchos::OrdinalTraits<Tpetra::global_size_t>::invalid();
    map = Teuchos::rcp(new Map(unknown, rows.size(), 0, own_nodes.getComm()));
    Vector own(nodes.getRowMap());
    own.putScalar(-1.0);
    {
      const auto view = own.getLocalViewHost(read_write);
      for (std::size_t c = 0; c < rows.size(); ++c)
        view(rows[c], 0) = static_cast<double>(map->getGlobalElement(static_cast<int>(c)));
    }
    const Vector all = algebra::on_columns(nodes, own);
    const auto view = all.getLocalViewHost(read_only);
    of_column.resize(view.extent(0));
    for (std::size_t c = 0; c < of_column.size(); ++c)
      of_column[c] = static_cast<GlobalOrdinal>(view(c, 0));
  }
};

/// Nodes without neighbours, unless the graph has no others.
void leave_out_single_nodes(const CrsMatrix& nodes, std::vector<char>& is_coarse) {
  Vector is_single(nodes.getRowMap());
  {
    const auto single = is_single.getLocalViewHost(overwrite_all);
    for (std::size_t i = 0; i < single.extent(0); ++i)
      single(i, 0) = nodes.getNumEntriesInLocalRow(static_cast<int>(i)) <= 1 ? 1.0 : 0.0;
  }
  if (is_single.norm1() == static_cast<double>(is_single.getGlobalLength())) return;
  const Vector on_all = algebra::on_columns(nodes, is_single);
  const auto single = on_all.getLocalViewHost(read_only);
  for (std::size_t c = 0; c < is_coarse.size(); ++c)
    if (single(c, 0) > 0.0) is_coarse[c] = 0;
}

Teuchos::RCP<const CrsMatrix> averaging(const CrsMatrix& nodes, const CoarseNumbers& coarse) {
  const auto P = Teuchos::rcp(new CrsMatrix(nodes.getRowMap(), longest_local_row(nodes)));
  const auto graph = nodes.getLocalMatrixHost().graph;
  std::vector<GlobalOrdinal> parents;
  for (int i = 0; i < static_cast<int>(n_local_rows(nodes)); ++i) {
    const GlobalOrdinal row = nodes.getRowMap()->getGlobalElement(i);
    const GlobalOrdinal own = coarse.of_column[nodes.getColMap()->getLocalElement(row)];
    parents.clear();
    if (own >= 0)
      parents.push_back(own);
    else
      for (auto k = graph.row_map(i); k < graph.row_map(i + 1); ++k)
        if (coarse.of_column[graph.entries(k)] >= 0)
          parents.push_back(coarse.of_column[graph.entries(k)]);
    const std::vector<Scalar> weights(parents.size(), 1.0 / static_cast<double>(parents.size()));
    P->insertGlobalValues(row, Teuchos::arrayViewFromVector(parents),
                          Teuchos::arrayViewFromVector(weights));
  }
  P->fillComplete(coarse.map, nodes.getRowMap());
  return P;
}

/// Coarse nodes are neighbours where any of their children are.
Teuchos::RCP<const CrsMatrix> coarse_graph(const CrsMatrix& nodes, const CrsMatrix& P) {
  CrsMatrix GP(nodes.getRowMap(), 0);
  Tpetra::MatrixMatrix::Multiply(algebra::with_ones(nodes), false, P, false, GP);
  const auto PtGP = Teuchos::rcp(new CrsMatrix(P.getDomainMap(), 0));
  Tpetra::MatrixMatrix::Multiply(P, true, GP, false, *PtGP);
  return PtGP;
}

Teuchos::RCP<const Vector> at_rows(const Vector& values, const CoarseNumbers& coarse) {
  const auto result = Teuchos::rcp(new Vector(coarse.map));
  const auto from = values.getLocalViewHost(read_only);
  const auto to = result->getLocalViewHost(overwrite_all);
  for (std::size_t c = 0; c < coarse.rows.size(); ++c) to(c, 0) = from(coarse.rows[c], 0);
  return result;
}

}  // namespace

NodalCoarsening::NodalCoarsening(const Teuchos::RCP<const CrsMatrix>& nodes, const Vector& order)
    : levels_{{nodes, Teuchos::rcp(new Vector(order, Teuchos::Copy)), Teuchos::null, {}}} {}

void NodalCoarsening::coarsen() {
  Level& level = levels_.back();
  std::vector<char> is_coarse = algebra::independent_set(*level.nodes, *level.order);
  leave_out_single_nodes(*level.nodes, is_coarse);
  const CoarseNumbers coarse(*level.nodes, is_coarse);
  level.P = averaging(*level.nodes, coarse);
  level.coarse_rows = coarse.rows;
  const auto graph = coarse_graph(*level.nodes, *level.P);
  levels_.push_back({graph, at_rows(*level.order, coarse), Teuchos::null, {}});
}

const NodalCoarsening::Level& NodalCoarsening::at(int level) {
  while (static_cast<int>(levels_.size()) <= level + 1) coarsen();
  return levels_[level];
}

}  // namespace tunica::multigrid
