#include "tunica/mesh/distributed/rows.hpp"

#include <algorithm>
#include <iterator>

#include "tunica/base/sort_once.hpp"

namespace tunica::mesh {

template <std::size_t N>
std::vector<int> vertices_of(const std::vector<std::array<int, N>>& elements) {
  constexpr std::size_t elements_at_once = std::size_t{1} << 18;  // of few rows repeated
  std::vector<int> all, some, both;
  for (std::size_t first = 0; first < elements.size(); first += elements_at_once) {
    some.clear();
    const std::size_t end = std::min(elements.size(), first + elements_at_once);
    for (std::size_t e = first; e < end; ++e)
      some.insert(some.end(), elements[e].begin(), elements[e].end());
    sort_once(some);
    both.clear();
    std::set_union(all.begin(), all.end(), some.begin(), some.end(), std::back_inserter(both));
    all.swap(both);
  }
  return all;
}

template std::vector<int> vertices_of(const std::vector<std::array<int, 3>>&);
template std::vector<int> vertices_of(const std::vector<std::array<int, 4>>&);

}  // namespace tunica::mesh
