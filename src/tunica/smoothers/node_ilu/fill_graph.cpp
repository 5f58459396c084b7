#include "tunica/smoothers/node_ilu/fill_graph.hpp"

#include <algorithm>
#include <functional>
#include <queue>

namespace tunica::smoothers {

namespace {

/// One row of the factors at a time.
class FillRow {
public:
  FillRow(int n_rows, int most) : level_(n_rows, -1), most_(most) {}

  void add(int column, int level) {
    if (level > most_) return;
    if (level_[column] < 0) {
      columns_.push_back(column);
      if (column < row_) pivots_.push(column);
      level_[column] = level;
    }
    // The shortest chain counts.
    level_[column] = std::min(level_[column], level);
  }
  void begin(int row) { row_ = row; }
  int level(int column) const { return level_[column]; }
  /// The next column before the diagonal, -1 after the last.
  int next_pivot() {
    if (pivots_.empty()) return -1;
    const int pivot = pivots_.top();
    pivots_.pop();
    return pivot;
  }
  /// Appends the columns, ascending, and their levels.
  void end(RowGraph& graph, std::vector<int>& levels) {
    std::sort(columns_.begin(), columns_.end());
    for (const int column : columns_) {
      graph.columns.push_back(column);
      levels.push_back(level_[column]);
      level_[column] = -1;
    }
    graph.start.push_back(graph.columns.size());
    columns_.clear();
  }

private:
  std::vector<int> level_;
  int most_, row_ = 0;
  std::vector<int> columns_;
  std::priority_queue<int, std::vector<int>, std::greater<>> pivots_;
};

}  // namespace

// lev(i, j) = min_k lev(i, k) + lev(k, j) + 1 over pivots k < i, j; zero for entries of the graph.
// What exceeds the level is dropped. Pivots of a row come ascending, those of fill among them.
std::optional<RowGraph> with_fill(const RowGraph& graph, int level, std::size_t most) {
  if (level == 0) return graph;
  RowGraph filled;
  std::vector<int> levels;  // of the entries of the filled graph
  FillRow row(graph.n_rows(), level);
  for (int i = 0; i < graph.n_rows(); ++i) {
    row.begin(i);
    for (std::size_t k = graph.start[i]; k < graph.start[i + 1]; ++k) row.add(graph.columns[k], 0);
    for (int pivot = row.next_pivot(); pivot >= 0; pivot = row.next_pivot())
      for (std::size_t k = filled.start[pivot]; k < filled.start[pivot + 1]; ++k)
        if (filled.columns[k] > pivot) row.add(filled.columns[k], row.level(pivot) + levels[k] + 1);
    row.end(filled, levels);
    if (filled.columns.size() > most) return std::nullopt;
  }
  filled.columns.shrink_to_fit();
  return filled;
}

}  // namespace tunica::smoothers
