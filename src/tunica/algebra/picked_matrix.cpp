#include "tunica/algebra/picked_matrix.hpp"

#include <algorithm>
#include <utility>

#include "tunica/algebra/independent_set.hpp"
#include "tunica/algebra/static_matrix.hpp"
#include "tunica/base/map_of.hpp"
#include "tunica/base/trilinos.hpp"

namespace tunica::algebra {

std::vector<int> flagged_rows(const Vector& flags) {
  std::vector<int> rows;
  const auto flag = flags.getLocalViewHost(read_only);
  for (std::size_t i = 0; i < flag.extent(0); ++i)
    if (flag(i, 0) != 0.0) rows.push_back(static_cast<int>(i));
  return rows;
}

Teuchos::RCP<const Map> flagged_map(const Vector& flags) {
  std::vector<GlobalOrdinal> numbers;
  for (const int row : flagged_rows(flags))
    numbers.push_back(flags.getMap()->getGlobalElement(row));
  return map_of(numbers, flags.getMap()->getComm());
}

namespace {

/// What is picked of a graph, and from where.
struct Pick {
  Teuchos::RCP<const Map> rows, with_ghosts, domain;
  RowStart row_start;
  LocalColumns columns;
  std::vector<std::size_t> offsets;  ///< of each entry in the graph

  Pick(const CrsGraph& G, const Vector& row_flags, const Vector& column_flags)
      : rows(flagged_map(row_flags)), domain(flagged_map(column_flags)) {
    const Vector flags = on_columns(G, column_flags);
    with_ghosts = flagged_map(flags);
    const std::vector<int> kept_columns = flagged_rows(flags), kept_rows = flagged_rows(row_flags);
    std::vector<int> place(flags.getLocalLength(), -1);
    for (std::size_t c = 0; c < kept_columns.size(); ++c)
      place[kept_columns[c]] = static_cast<int>(c);
    const auto from = G.getLocalGraphHost();
    std::vector<int> entries;
    row_start = RowStart("row start", kept_rows.size() + 1);
    for (std::size_t r = 0; r < kept_rows.size(); ++r) {
      for (auto k = from.row_map(kept_rows[r]); k < from.row_map(kept_rows[r] + 1); ++k)
        if (const int column = place[from.entries(k)]; column >= 0) {
          entries.push_back(column);
          offsets.push_back(k);
        }
      row_start(r + 1) = entries.size();
    }
    columns = LocalColumns("columns", entries.size());
    std::copy(entries.begin(), entries.end(), columns.data());
  }

  Teuchos::RCP<CrsGraph> graph() const {
    return static_graph(rows, with_ghosts, row_start, columns, domain);
  }
};

}  // namespace

PickedMatrix::PickedMatrix(const CrsMatrix& K, const Vector& rows, const Vector& columns) {
  Pick pick(*K.getCrsGraph(), rows, columns);
  matrix_ = matrix_on(pick.graph());
  offsets_ = std::move(pick.offsets);
  refresh(K);
}

Teuchos::RCP<CrsGraph> picked_graph(const CrsGraph& G, const Vector& rows, const Vector& columns) {
  return Pick(G, rows, columns).graph();
}

void PickedMatrix::refresh(const CrsMatrix& K) {
  const auto from = K.getLocalMatrixHost().values;
  matrix_->resumeFill();
  {
    const auto to = matrix_->getLocalMatrixHost().values;
    for (std::size_t k = 0; k < offsets_.size(); ++k) to(k) = from(offsets_[k]);
  }
  matrix_->fillComplete(matrix_->getDomainMap(), matrix_->getRangeMap());
}

Teuchos::RCP<CrsMatrix> renumbered(const CrsMatrix& A) {
  const auto unknown = Teuchos::OrdinalTraits<Tpetra::global_size_t>::invalid();
  const auto rows = Teuchos::rcp(new Map(unknown, n_local(*A.getRowMap()), 0, A.getComm()));
  Vector numbers(A.getRowMap());
  {
    const auto view = numbers.getLocalViewHost(overwrite_all);
    for (std::size_t i = 0; i < view.extent(0); ++i)
      view(i, 0) = static_cast<Scalar>(rows->getGlobalElement(static_cast<int>(i)));
  }
  const Vector in_columns = on_columns(A, numbers);
  const auto number = in_columns.getLocalViewHost(read_only);
  std::vector<GlobalOrdinal> columns;
  for (std::size_t c = 0; c < number.extent(0); ++c)
    columns.push_back(static_cast<GlobalOrdinal>(number(c, 0)));
  const auto local = A.getLocalMatrixDevice();
  const auto result = Teuchos::rcp(new CrsMatrix(
      rows, map_of(columns, A.getComm()), local.graph.row_map, local.graph.entries, local.values));
  result->expertStaticFillComplete(rows, rows);
  return result;
}

void pick_rows(const std::vector<int>& rows, const MultiVector& x, MultiVector& picked) {
  const auto from = x.getLocalViewHost(read_only);
  const auto to = picked.getLocalViewHost(overwrite_all);
  for (std::size_t j = 0; j < to.extent(1); ++j)
    for (std::size_t i = 0; i < rows.size(); ++i) to(i, j) = from(rows[i], j);
}

void add_rows(const std::vector<int>& rows, double factor, const MultiVector& picked,
              MultiVector& x) {
  const auto from = picked.getLocalViewHost(read_only);
  const auto to = x.getLocalViewHost(read_write);
  for (std::size_t j = 0; j < to.extent(1); ++j)
    for (std::size_t i = 0; i < rows.size(); ++i) to(rows[i], j) += factor * from(i, j);
}

}  // namespace tunica::algebra
