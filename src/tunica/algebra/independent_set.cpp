#include "tunica/algebra/independent_set.hpp"

#include <Teuchos_CommHelpers.hpp>

#include "tunica/base/trilinos.hpp"

namespace tunica::algebra {

namespace {

constexpr double undecided = 0.0, coarse = 1.0, fine = -1.0;

/// A node is coarse when all neighbours before it are known to be fine. Undecided only where
/// that hangs on another rank.
template <class States, class Order>
double decide(const CrsGraph& nodes, int row, int own, const States& states, const Order& order) {
  const auto graph = nodes.getLocalGraphHost();
  double decision = coarse;
  for (auto k = graph.row_map(row); k < graph.row_map(row + 1); ++k) {
    const LocalOrdinal column = graph.entries(k);
    if (states(column, 0) == coarse) return fine;
    const bool is_before = order(column, 0) < order(own, 0);
    if (is_before && states(column, 0) == undecided) decision = undecided;
  }
  return decision;
}

/// One pass over the own nodes; how many stay undecided.
int decide_all(const CrsGraph& nodes, const Vector& order, Vector& states) {
  const auto numbers = order.getLocalViewHost(read_only);
  const auto view = states.getLocalViewHost(read_write);
  int n_left = 0;
  for (int i = 0; i < static_cast<int>(n_local_rows(nodes)); ++i) {
    const auto own = nodes.getColMap()->getLocalElement(nodes.getRowMap()->getGlobalElement(i));
    if (view(own, 0) != undecided) continue;
    view(own, 0) = decide(nodes, i, own, view, numbers);
    n_left += view(own, 0) == undecided ? 1 : 0;
  }
  return n_left;
}

Vector rows_of(const CrsGraph& nodes, const Vector& columns) {
  Vector rows(nodes.getRowMap());
  const auto from = columns.getLocalViewHost(read_only);
  const auto to = rows.getLocalViewHost(overwrite_all);
  for (std::size_t i = 0; i < to.extent(0); ++i) {
    const GlobalOrdinal number = nodes.getRowMap()->getGlobalElement(static_cast<int>(i));
    to(i, 0) = from(nodes.getColMap()->getLocalElement(number), 0);
  }
  return rows;
}

}  // namespace

void fetch_columns(const CrsGraph& graph, const MultiVector& rows, MultiVector& columns) {
  const auto importer = graph.getImporter();
  if (importer.is_null())
    columns.assign(rows);
  else
    columns.doImport(rows, *importer, insert);
}

Vector on_columns(const CrsGraph& graph, const Vector& rows) {
  Vector columns(graph.getColMap());
  fetch_columns(graph, rows, columns);
  return columns;
}

std::vector<char> independent_set(const CrsGraph& nodes, const Vector& order) {
  const Vector numbers = on_columns(nodes, order);
  Vector states(nodes.getColMap());
  int n_left = 1;
  while (n_left > 0) {
    const int n_mine = decide_all(nodes, numbers, states);
    Teuchos::reduceAll(*nodes.getComm(), Teuchos::REDUCE_SUM, n_mine, Teuchos::outArg(n_left));
    states = on_columns(nodes, rows_of(nodes, states));
  }
  const auto view = states.getLocalViewHost(read_only);
  std::vector<char> is_coarse(view.extent(0));
  for (std::size_t c = 0; c < is_coarse.size(); ++c) is_coarse[c] = view(c, 0) == coarse;
  return is_coarse;
}

}  // namespace tunica::algebra
