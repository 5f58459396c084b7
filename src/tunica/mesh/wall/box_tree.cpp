#include "tunica/mesh/wall/box_tree.hpp"

#include <limits>
#include <numeric>

namespace tunica::mesh::wall {
namespace {

constexpr double huge = std::numeric_limits<double>::max();
constexpr Box nothing{{huge, huge, huge}, {-huge, -huge, -huge}};
constexpr int most_in_leaf = 4;

}  // namespace

Box box_of(const std::vector<Vec3>& points) {
  Box box = nothing;
  for (const Vec3& point : points) box.add(point);
  return box;
}

BoxTree::BoxTree(const std::vector<Box>& boxes) : items_(boxes.size()) {
  std::iota(items_.begin(), items_.end(), 0);
  nodes_.push_back({nothing, 0, static_cast<int>(items_.size()), -1});
  for (std::size_t node = 0; node < nodes_.size(); ++node) split(static_cast<int>(node), boxes);
}

void BoxTree::split(int node, const std::vector<Box>& boxes) {
  const auto middle = [&](int item, int axis) {
    return boxes[item].low[axis] + boxes[item].high[axis];
  };
  Node& mine = nodes_[node];
  Box middles = nothing;
  for (int i = mine.begin; i < mine.end; ++i) {
    const int item = items_[i];
    mine.box.add(boxes[item].low);
    mine.box.add(boxes[item].high);
    middles.add({middle(item, 0), middle(item, 1), middle(item, 2)});
  }
  if (mine.end - mine.begin <= most_in_leaf) return;
  const Vec3 extent = middles.high - middles.low;
  const int axis =
      static_cast<int>(std::max_element(extent.begin(), extent.end()) - extent.begin());
  const int begin = mine.begin, end = mine.end, half = begin + (end - begin) / 2;
  std::nth_element(items_.begin() + begin, items_.begin() + half, items_.begin() + end,
                   [&](int a, int b) { return middle(a, axis) < middle(b, axis); });
  mine.left = static_cast<int>(nodes_.size());
  nodes_.push_back({nothing, begin, half, -1});
  nodes_.push_back({nothing, half, end, -1});
}

}  // namespace tunica::mesh::wall
