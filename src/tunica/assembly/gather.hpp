#pragma once
#include <array>
#include <vector>

namespace tunica::assembly {

/// Values at the nodes of an element.
template <class T, std::size_t n>
std::array<T, n> gather(const std::vector<T>& values, const std::array<int, n>& nodes) {
  std::array<T, n> local;
  for (std::size_t a = 0; a < n; ++a) local[a] = values[nodes[a]];
  return local;
}

}  // namespace tunica::assembly
