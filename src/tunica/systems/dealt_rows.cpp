#include "tunica/systems/dealt_rows.hpp"

#include <algorithm>
#include <array>

#include "tunica/algebra/static_matrix.hpp"
#include "tunica/base/map_of.hpp"
#include "tunica/base/trilinos.hpp"

namespace tunica::systems {

namespace {

Teuchos::RCP<const Map> dealt_map(const std::vector<GlobalOrdinal>& numbers,
                                  const std::vector<int>& ranks, const CommPtr& comm) {
  std::vector<GlobalOrdinal> mine = exchange_to(*comm, numbers, ranks).items;
  std::sort(mine.begin(), mine.end());
  return map_of(mine, comm);
}

/// Entries of each row that the rank is dealt.
std::vector<std::size_t> dealt_lengths(const SparseRows& A, const Deal& rows) {
  using Length = std::array<GlobalOrdinal, 2>;  // of a row, entries
  std::vector<Length> mine;
  for (std::size_t i = 0; i < A.n_local_rows(); ++i)
    mine.push_back({rows.numbers[i], static_cast<GlobalOrdinal>(A.start[i + 1] - A.start[i])});
  std::vector<std::size_t> lengths(n_local(*rows.dealt));
  for (const auto& [row, entries] : exchange_to(*A.comm, mine, rows.ranks).items)
    lengths[rows.dealt->getLocalElement(row)] = static_cast<std::size_t>(entries);
  return lengths;
}

/// Sends what make(i, k) makes of entry k in row i to the rank of the row, which takes it.
template <class Make, class Take>
void deal_entries(const SparseRows& A, const Deal& rows, const Make& make, const Take& take) {
  in_batches(A, [&](std::size_t first, std::size_t last) {
    std::vector<decltype(make(first, first))> items;
    std::vector<int> ranks;
    for (std::size_t i = first; i < last; ++i)
      for (std::size_t k = A.start[i]; k < A.start[i + 1]; ++k) {
        items.push_back(make(i, k));
        ranks.push_back(rows.ranks[i]);
      }
    for (const auto& item : exchange_to(*A.comm, items, ranks).items) take(item);
  });
}

}  // namespace

Deal::Deal(std::vector<GlobalOrdinal> numbers_of_rows, std::vector<int> ranks_of_rows,
           const CommPtr& comm)
    : numbers(std::move(numbers_of_rows)), ranks(std::move(ranks_of_rows)),
      portions(map_of(numbers, comm)), dealt(dealt_map(numbers, ranks, comm)) {}

Teuchos::RCP<CrsMatrix> dealt(MatrixRows A, const Deal& rows, const Deal& columns) {
  const Fetched<GlobalOrdinal> number_of(*A.comm, columns_of(A), columns.numbers, A.n_columns);
  algebra::EntryRows entries(dealt_lengths(A, rows));
  deal_entries(
      A, rows,
      [&](std::size_t i, std::size_t k) {
        return Entry{rows.numbers[i], number_of(A.columns[k]), A.values[k]};
      },
      [&](const Entry& e) { entries.add(rows.dealt->getLocalElement(e.row), e.column, e.value); });
  A = {};
  return entries.take(rows.dealt, columns.dealt);
}

Teuchos::RCP<Vector> dealt(const std::vector<double>& values, const Deal& rows) {
  Vector in_portions(rows.portions);
  {
    const auto to = in_portions.getLocalViewHost(overwrite_all);
    for (std::size_t i = 0; i < to.extent(0); ++i) to(i, 0) = values[i];
  }
  const auto result = Teuchos::rcp(new Vector(rows.dealt));
  result->doImport(in_portions, Import(rows.portions, rows.dealt), insert);
  return result;
}

algebra::NodePlaces dealt(const std::vector<ColumnRows>& coordinates, const algebra::Nodes& nodes) {
  const Teuchos::RCP<const Map> map = nodes.graph->getRowMap();
  const ColumnRows& first = coordinates.front();
  MultiVector portions(Teuchos::rcp(new Map(first.n_rows, first.values.size(), 0, map->getComm())),
                       coordinates.size());
  {
    const auto to = portions.getLocalViewHost(overwrite_all);
    for (std::size_t j = 0; j < coordinates.size(); ++j)
      for (std::size_t a = 0; a < to.extent(0); ++a) to(a, j) = coordinates[j].values[a];
  }
  const auto places = Teuchos::rcp(new MultiVector(map, coordinates.size()));
  places->doImport(portions, Import(portions.getMap(), map), insert);
  const auto in_solid = Teuchos::rcp(new Vector(map));
  {
    const auto to = in_solid->getLocalViewHost(overwrite_all);
    for (std::size_t a = 0; a < to.extent(0); ++a)
      to(a, 0) = map->getGlobalElement(static_cast<LocalOrdinal>(a)) < first.n_rows;
  }
  return {places, in_solid};
}

algebra::Nodes dealt(NodeGraph graph, const std::vector<int>& ranks) {
  std::vector<GlobalOrdinal> numbers;
  std::vector<int> ranks_of_numbers;
  for (std::size_t i = 0; i < ranks.size(); ++i) {
    if (graph.start[i] == graph.start[i + 1]) continue;
    numbers.push_back(graph.first_row() + static_cast<long long>(i));
    ranks_of_numbers.push_back(ranks[i]);
  }
  graph.start.erase(std::unique(graph.start.begin(), graph.start.end()), graph.start.end());
  const Deal rows(std::move(numbers), std::move(ranks_of_numbers), graph.comm);
  algebra::EntryRows entries(dealt_lengths(graph, rows));
  using Edge = std::array<GlobalOrdinal, 2>;
  deal_entries(
      graph, rows,
      [&](std::size_t i, std::size_t k) {
        return Edge{rows.numbers[i], graph.columns[k]};
      },
      [&](const Edge& edge) { entries.add(rows.dealt->getLocalElement(edge[0]), edge[1], 1.0); });
  const auto order = Teuchos::rcp(new Vector(rows.dealt));
  for (const GlobalOrdinal node : global_numbers(*rows.dealt))
    order->replaceGlobalValue(node, static_cast<Scalar>(node));
  return {entries.take(rows.dealt, rows.dealt)->getCrsGraph(), order};
}

}  // namespace tunica::systems
