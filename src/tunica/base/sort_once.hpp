#pragma once
#include <algorithm>
#include <vector>

namespace tunica {

/// Sorts them, and leaves of equal ones one.
template <class T>
void sort_once(std::vector<T>& items) {
  std::sort(items.begin(), items.end());
  items.erase(std::unique(items.begin(), items.end()), items.end());
}

}  // namespace tunica
