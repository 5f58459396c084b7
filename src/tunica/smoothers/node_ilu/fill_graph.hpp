#pragma once
#include <cstddef>
#include <optional>
#include <vector>

namespace tunica::smoothers {

/// Columns of each row, ascending.
struct RowGraph {
  std::vector<std::size_t> start{0};
  std::vector<int> columns;

  int n_rows() const { return static_cast<int>(start.size()) - 1; }
};

/// The graph of the factors ILU(k) [Sa03, 10.3.3]: what elimination in the given order fills by
/// chains of at most level steps. Both with all diagonal entries. level 0: the graph itself. None
/// where it would have more than so many columns.
std::optional<RowGraph> with_fill(const RowGraph& graph, int level, std::size_t most);

}  // namespace tunica::smoothers
