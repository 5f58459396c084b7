#pragma once
#include <cstddef>
#include <vector>

#include "tunica/base/types.hpp"

namespace tunica::algebra {

/// Local rows of a graph: the entries of row r begin at row_start(r).
using RowStart = CrsMatrix::local_graph_device_type::row_map_type::non_const_type;
using LocalColumns = CrsMatrix::local_graph_device_type::entries_type::non_const_type;

/// A graph with these local columns, which ascend in each row. with_ghosts: what the local columns
/// number; its range are the rows. Collective.
Teuchos::RCP<CrsGraph> static_graph(const Teuchos::RCP<const Map>& rows,
                                    const Teuchos::RCP<const Map>& with_ghosts,
                                    const RowStart& row_start, const LocalColumns& columns,
                                    const Teuchos::RCP<const Map>& domain);

/// The numbers of a map, and behind them those of these that it lacks, by the ranks that have them.
/// Collective.
Teuchos::RCP<const Map> map_with_ghosts(std::vector<GlobalOrdinal> columns,
                                        const Teuchos::RCP<const Map>& map);

/// The rank's rows of a matrix that is made: room for so many entries of each, in any order, no
/// column twice.
class EntryRows {
public:
  explicit EntryRows(const std::vector<std::size_t>& most);

  void add(std::size_t row, GlobalOrdinal column, Scalar value) {
    columns_[end_[row]] = column;
    values_[end_[row]++] = value;
  }
  /// Tpetra inserts entries one by one in several times the time. Leaves none. Collective.
  Teuchos::RCP<CrsMatrix> take(const Teuchos::RCP<const Map>& rows,
                               const Teuchos::RCP<const Map>& domain);

private:
  std::vector<std::size_t> start_, end_;
  std::vector<GlobalOrdinal> columns_;
  std::vector<Scalar> values_;
};

/// A square graph with these columns in the rank's rows; none twice. Collective.
Teuchos::RCP<const CrsGraph> graph_of_rows(const std::vector<std::vector<GlobalOrdinal>>& columns,
                                           const Teuchos::RCP<const Map>& rows);

/// A matrix with the entries of a graph, all of this value, and ready for products. Collective.
Teuchos::RCP<CrsMatrix> matrix_on(const Teuchos::RCP<const CrsGraph>& graph, Scalar value = 0.0);

}  // namespace tunica::algebra
