#pragma once
#include <algorithm>
#include <vector>

#include "tunica/base/types.hpp"

namespace tunica::algebra {

using LocalGraph = CrsMatrix::local_matrix_host_type::staticcrsgraph_type;

/// The rows of a graph; none where a rank has not even the beginning of one.
inline int n_rows(const LocalGraph& graph) {
  return std::max(static_cast<int>(graph.row_map.extent(0)) - 1, 0);
}

/// Neighbours that are worked on together, such as the rows or columns of a node.
struct Groups {
  static constexpr int most = 4;  ///< of a group
  std::vector<int> start;         ///< the first of each, and the number of all
  std::vector<int> of;            ///< by row or column

  int size() const { return static_cast<int>(start.size()) - 1; }
  int length(int group) const { return start[group + 1] - start[group]; }
};

/// Groups of neighbours for which is_with(i) says that i belongs to the one before it.
template <class IsWith>
Groups groups_of(int n, const IsWith& is_with) {
  Groups groups;
  groups.of.reserve(n);
  for (int i = 0; i < n; ++i) {
    if (i == 0 || i - groups.start.back() == Groups::most || !is_with(i)) groups.start.push_back(i);
    groups.of.push_back(static_cast<int>(groups.start.size()) - 1);
  }
  groups.start.push_back(n);
  return groups;
}

/// Rows that follow each other and have the same columns; start(i): where those of row i begin.
template <class Start>
Groups groups_of_rows(int n, const Start& start, const int* columns) {
  return groups_of(n, [&](int i) {
    return std::equal(columns + start(i - 1), columns + start(i), columns + start(i),
                      columns + start(i + 1));
  });
}

}  // namespace tunica::algebra
