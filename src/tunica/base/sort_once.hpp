#pragma once
#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace tunica {

/// Sorts them, and leaves of equal ones one.
template <class T>
void sort_once(std::vector<T>& items) {
  std::sort(items.begin(), items.end());
  items.erase(std::unique(items.begin(), items.end()), items.end());
}

/// Each of the items that come again and again once: sorts them whenever they have doubled.
template <class T>
class Once {
public:
  void add(const T& item) {
    items_.push_back(item);
    if (items_.size() < most_) return;
    sort_once(items_);
    most_ = std::max(most_, 2 * items_.size());
  }
  /// Ascending; leaves none.
  std::vector<T> take() {
    sort_once(items_);
    return std::exchange(items_, {});
  }

private:
  std::vector<T> items_;
  std::size_t most_ = 4096;
};

}  // namespace tunica
