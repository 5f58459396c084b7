#include "tunica/linear/direct/level_widths.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace tunica::linear {

namespace {

/// Levels of a search in breadth.
struct Levels {
  std::vector<int> widths;
  int found = 0;  ///< unknowns of all levels
  int last = 0;   ///< one of the last level
};

class Search {
public:
  Search(int n, const Entries& entries) : entries_(&entries), starts_(n + 1, 0), mark_(n, 0) {
    for (const int row : entries.rows) ++starts_[row];
    for (int i = 0; i < n; ++i) starts_[i + 1] += starts_[i];
    // Rows that reach all over, such as those of a mean value, say nothing of the others.
    longest_ = static_cast<std::size_t>(1000 + 10 * std::sqrt(n));
  }

  Levels from(int start) {
    Levels levels;
    std::vector<int> level{start}, next;
    mark_[start] = ++round_;
    while (!level.empty()) {
      levels.widths.push_back(static_cast<int>(level.size()));
      levels.found += levels.widths.back();
      levels.last = level.front();
      next.clear();
      for (const int i : level) visit_neighbours(i, next);
      level.swap(next);
    }
    return levels;
  }

  /// Those of the piece that has half of all coupled unknowns, from some place in it; none where no
  /// piece has as many.
  Levels of_largest_piece() {
    const auto n = static_cast<int>(mark_.size());
    int coupled = 0;
    for (int i = 0; i < n; ++i) coupled += is_coupled(i);
    for (int i = 0; i < n; ++i) {
      if (mark_[i] != 0 || !is_coupled(i)) continue;
      const Levels levels = from(i);
      if (2 * levels.found >= coupled) return levels;
    }
    return {};
  }

private:
  bool is_coupled(int i) const { return starts_[i + 1] - starts_[i] > 1; }
  void visit_neighbours(int i, std::vector<int>& next) {
    if (starts_[i + 1] - starts_[i] > longest_) return;
    for (std::size_t k = starts_[i]; k < starts_[i + 1]; ++k) {
      const int j = entries_->columns[k] - 1;
      if (mark_[j] == round_) continue;
      mark_[j] = round_;
      next.push_back(j);
    }
  }

  const Entries* entries_;
  std::vector<std::size_t> starts_;
  std::vector<int> mark_;  ///< the last round in which each was found
  int round_ = 0;
  std::size_t longest_;
};

}  // namespace

double narrowest_level(int n, const Entries& entries) {
  Search search(n, entries);
  const Levels any = search.of_largest_piece();
  if (any.found == 0) return 0.0;
  const Levels levels = search.from(any.last);
  int before = 0, narrowest = 0;
  for (const int width : levels.widths) {
    const int behind = levels.found - before - width;
    const bool is_in_middle = 4 * before >= levels.found && 4 * behind >= levels.found;
    if (is_in_middle && (narrowest == 0 || width < narrowest)) narrowest = width;
    before += width;
  }
  return narrowest;
}

}  // namespace tunica::linear
