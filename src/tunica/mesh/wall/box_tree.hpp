#pragma once
#include <algorithm>
#include <vector>

#include "tunica/base/tensor.hpp"

namespace tunica::mesh::wall {

/// A box along the axes.
struct Box {
  Vec3 low, high;

  void add(const Vec3& point) {
    for (int i = 0; i < 3; ++i) {
      low[i] = std::min(low[i], point[i]);
      high[i] = std::max(high[i], point[i]);
    }
  }
  bool overlaps(const Box& other) const {
    for (int i = 0; i < 3; ++i)
      if (low[i] > other.high[i] || other.low[i] > high[i]) return false;
    return true;
  }
  /// Square of the distance to a point; 0 inside.
  double distance2(const Vec3& point) const {
    double sum = 0.0;
    for (int i = 0; i < 3; ++i) {
      const double outside = std::max({0.0, low[i] - point[i], point[i] - high[i]});
      sum += outside * outside;
    }
    return sum;
  }
};

Box box_of(const std::vector<Vec3>& points);

/// A balanced binary tree of boxes: what is near is found in O(log n), whatever the sizes.
class BoxTree {
public:
  explicit BoxTree(const std::vector<Box>& boxes);

  /// Calls visit(item) for the items in nodes that are within reach, those near the place first.
  /// may_reach(box) is asked again for each node, so that the reach may shrink on the way.
  template <typename MayReach, typename Visit>
  void search(const Vec3& place, const MayReach& may_reach, const Visit& visit) const {
    std::vector<int> waiting{0};
    while (!waiting.empty()) {
      const Node& node = nodes_[waiting.back()];
      waiting.pop_back();
      if (!may_reach(node.box)) continue;
      if (node.left < 0) {
        for (int i = node.begin; i < node.end; ++i) visit(items_[i]);
        continue;
      }
      const bool is_left_nearer =
          nodes_[node.left].box.distance2(place) <= nodes_[node.left + 1].box.distance2(place);
      waiting.push_back(node.left + (is_left_nearer ? 1 : 0));
      waiting.push_back(node.left + (is_left_nearer ? 0 : 1));
    }
  }

private:
  struct Node {
    Box box;
    int begin, end;  ///< in items_
    int left;        ///< the other child follows it; -1 in a leaf
  };
  void split(int node, const std::vector<Box>& boxes);

  std::vector<Node> nodes_;
  std::vector<int> items_;
};

}  // namespace tunica::mesh::wall
