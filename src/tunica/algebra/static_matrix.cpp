#include "tunica/algebra/static_matrix.hpp"

#include <algorithm>
#include <tuple>
#include <utility>

#include "tunica/base/map_of.hpp"
#include "tunica/base/sort_once.hpp"
#include "tunica/base/trilinos.hpp"

namespace tunica::algebra {

Teuchos::RCP<CrsGraph> static_graph(const Teuchos::RCP<const Map>& rows,
                                    const Teuchos::RCP<const Map>& with_ghosts,
                                    const RowStart& row_start, const LocalColumns& columns,
                                    const Teuchos::RCP<const Map>& domain) {
  const auto graph = Teuchos::rcp(new CrsGraph(rows, with_ghosts, row_start, columns));
  graph->expertStaticFillComplete(domain, rows);
  return graph;
}

Teuchos::RCP<const CrsGraph> graph_of_rows(const std::vector<std::vector<GlobalOrdinal>>& columns,
                                           const Teuchos::RCP<const Map>& rows) {
  std::vector<std::size_t> counts;
  for (const auto& row : columns) counts.push_back(row.size());
  EntryRows entries(counts);
  for (std::size_t i = 0; i < columns.size(); ++i)
    for (const GlobalOrdinal column : columns[i]) entries.add(i, column, 1.0);
  return entries.take(rows, rows)->getCrsGraph();
}

Teuchos::RCP<CrsMatrix> matrix_on(const Teuchos::RCP<const CrsGraph>& graph, Scalar value) {
  const auto matrix = Teuchos::rcp(new CrsMatrix(graph));
  matrix->setAllToScalar(value);
  matrix->fillComplete(graph->getDomainMap(), graph->getRangeMap());
  return matrix;
}

Teuchos::RCP<const Map> map_with_ghosts(std::vector<GlobalOrdinal> columns,
                                        const Teuchos::RCP<const Map>& map) {
  columns.erase(std::remove_if(columns.begin(), columns.end(),
                               [&](GlobalOrdinal c) { return map->isNodeGlobalElement(c); }),
                columns.end());
  sort_once(columns);
  std::vector<int> owners(columns.size());
  map->getRemoteIndexList(Teuchos::arrayViewFromVector(columns),
                          Teuchos::arrayViewFromVector(owners));
  std::vector<std::pair<int, GlobalOrdinal>> by_rank;
  for (std::size_t k = 0; k < columns.size(); ++k) by_rank.emplace_back(owners[k], columns[k]);
  std::sort(by_rank.begin(), by_rank.end());
  const auto own = global_numbers(*map);
  std::vector<GlobalOrdinal> all(own.begin(), own.end());
  for (const auto& [owner, ghost] : by_rank) all.push_back(ghost);
  return map_of(all, map->getComm());
}

EntryRows::EntryRows(const std::vector<std::size_t>& most) : start_(1, 0) {
  for (const std::size_t n : most) start_.push_back(start_.back() + n);
  end_.assign(start_.begin(), start_.end() - 1);
  columns_.resize(start_.back());
  values_.resize(start_.back());
}

Teuchos::RCP<CrsMatrix> EntryRows::take(const Teuchos::RCP<const Map>& rows,
                                        const Teuchos::RCP<const Map>& domain) {
  std::vector<GlobalOrdinal> reached;
  RowStart row_start("row start", end_.size() + 1);
  for (std::size_t i = 0; i < end_.size(); ++i) {
    row_start(i + 1) = row_start(i) + (end_[i] - start_[i]);
    for (std::size_t k = start_[i]; k < end_[i]; ++k)
      if (!domain->isNodeGlobalElement(columns_[k])) reached.push_back(columns_[k]);
  }
  const Teuchos::RCP<const Map> with_ghosts = map_with_ghosts(std::move(reached), domain);
  const std::size_t n = row_start(end_.size());
  LocalColumns columns("columns", n);
  CrsMatrix::local_matrix_device_type::values_type values("values", n);
  std::vector<std::pair<LocalOrdinal, Scalar>> row;
  for (std::size_t i = 0; i < end_.size(); ++i) {
    row.clear();
    for (std::size_t k = start_[i]; k < end_[i]; ++k)
      row.emplace_back(with_ghosts->getLocalElement(columns_[k]), values_[k]);
    std::sort(row.begin(), row.end());
    for (std::size_t k = 0; k < row.size(); ++k)
      std::tie(columns(row_start(i) + k), values(row_start(i) + k)) = row[k];
  }
  *this = EntryRows({});
  const auto matrix = Teuchos::rcp(new CrsMatrix(rows, with_ghosts, row_start, columns, values));
  matrix->expertStaticFillComplete(domain, rows);
  return matrix;
}

}  // namespace tunica::algebra
