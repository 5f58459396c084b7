#include "multigrid/nodal_coarsening.hpp"

#include <TpetraExt_MatrixMatrix.hpp>

#include "multigrid/expanded_map.hpp"
#include "multigrid/independent_set.hpp"

namespace tunica::multigrid {

namespace {

/// Numbers the nodes of the set rank by rank; the value at a ghost is that of its owner, and
/// -1 outside the set.
struct CoarseNumbers {
  Teuchos::RCP<const Map> map;
  std::vector<GlobalOrdinal> of_column;

  CoarseNumbers(const CrsMatrix& nodes, const std::vector<char>& is_coarse) {
    std::size_t n = 0;
    const Map& rows = *nodes.getRowMap();
    const Map& columns = *nodes.getColMap();
    for (std::size_t i = 0; i < rows.getNodeNumElements(); ++i)
      n += is_coarse[columns.getLocalElement(rows.getGlobalElement(static_cast<int>(i)))];
    const auto unknown = Teuchos::OrdinalTraits<Tpetra::global_size_t>::invalid();
    map = Teuchos::rcp(new Map(unknown, n, 0, rows.getComm()));
    Vector own(nodes.getRowMap());
    {
      const auto view = own.getLocalViewHost(overwrite_all);
      LocalOrdinal next = 0;
      for (std::size_t i = 0; i < view.extent(0); ++i) {
        const auto column = columns.getLocalElement(rows.getGlobalElement(static_cast<int>(i)));
        view(i, 0) = is_coarse[column] ? static_cast<double>(map->getGlobalElement(next++)) : -1.0;
      }
    }
    const Vector all = on_columns(nodes, own);
    const auto view = all.getLocalViewHost(read_only);
    of_column.resize(view.extent(0));
    for (std::size_t c = 0; c < of_column.size(); ++c)
      of_column[c] = static_cast<GlobalOrdinal>(view(c, 0));
  }
};

Teuchos::RCP<const CrsMatrix> averaging(const CrsMatrix& nodes, const CoarseNumbers& coarse) {
  const auto P = Teuchos::rcp(new CrsMatrix(nodes.getRowMap(), nodes.getNodeMaxNumRowEntries()));
  const auto graph = nodes.getLocalMatrixHost().graph;
  std::vector<GlobalOrdinal> parents;
  for (int i = 0; i < static_cast<int>(nodes.getNodeNumRows()); ++i) {
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
  CrsMatrix ones(nodes, Teuchos::Copy);
  ones.resumeFill();
  ones.setAllToScalar(1.0);  // nothing cancels in the products
  ones.fillComplete(nodes.getDomainMap(), nodes.getRangeMap());
  CrsMatrix GP(nodes.getRowMap(), 0);
  Tpetra::MatrixMatrix::Multiply(ones, false, P, false, GP);
  const auto PtGP = Teuchos::rcp(new CrsMatrix(P.getDomainMap(), 0));
  Tpetra::MatrixMatrix::Multiply(P, true, GP, false, *PtGP);
  return PtGP;
}

/// P ⊗ I.
Teuchos::RCP<const CrsMatrix> expanded(const CrsMatrix& P, int dofs) {
  const auto result =
      Teuchos::rcp(new CrsMatrix(expanded_map(*P.getRowMap(), dofs), P.getNodeMaxNumRowEntries()));
  const auto local = P.getLocalMatrixHost();
  std::vector<GlobalOrdinal> columns;
  for (int a = 0; a < local.numRows(); ++a) {
    const auto row = local.rowConst(a);
    const std::vector<Scalar> values(&row.value(0), &row.value(0) + row.length);
    for (int i = 0; i < dofs; ++i) {
      columns.clear();
      for (int k = 0; k < row.length; ++k)
        columns.push_back(dofs * P.getColMap()->getGlobalElement(row.colidx(k)) + i);
      result->insertGlobalValues(dofs * P.getRowMap()->getGlobalElement(a) + i,
                                 Teuchos::arrayViewFromVector(columns),
                                 Teuchos::arrayViewFromVector(values));
    }
  }
  result->fillComplete(expanded_map(*P.getDomainMap(), dofs), result->getRowMap());
  return result;
}

}  // namespace

NodalCoarsening::NodalCoarsening(const Teuchos::RCP<const CrsMatrix>& nodes) : graphs_{nodes} {}

void NodalCoarsening::add_level() {
  const CrsMatrix& nodes = *graphs_.back();
  const CoarseNumbers coarse(nodes, independent_set(nodes));
  const auto P = averaging(nodes, coarse);
  prolongators_.push_back({{1, P}});
  graphs_.push_back(coarse_graph(nodes, *P));
}

Teuchos::RCP<const CrsMatrix> NodalCoarsening::prolongator(int level, int dofs) {
  while (static_cast<int>(prolongators_.size()) <= level) add_level();
  auto& known = prolongators_[level];
  auto found = known.find(dofs);
  if (found == known.end()) found = known.emplace(dofs, expanded(*known.at(1), dofs)).first;
  return found->second;
}

long long NodalCoarsening::n_nodes(int level) {
  while (static_cast<int>(graphs_.size()) <= level) add_level();
  return static_cast<long long>(graphs_[level]->getGlobalNumRows());
}

}  // namespace tunica::multigrid
