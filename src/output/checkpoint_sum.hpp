#pragma once
#include <vector>

#include "base/hash.hpp"
#include "fields/state.hpp"

namespace tunica::output {

/// Sum of the hashes of all rows with their vertices, modulo 2^64: the same in whatever order and
/// on whatever ranks the rows stand.
inline std::uint64_t checksum(const std::vector<int>& vertices, const fields::State::Array& rows) {
  std::uint64_t sum = 0;
  for (std::size_t r = 0; r < vertices.size(); ++r) {
    const std::uint64_t start = hash_bytes(&vertices[r], sizeof vertices[r]);
    sum += hash_bytes(rows.values.data() + r * rows.columns, rows.columns * sizeof(double), start);
  }
  return sum;
}

}  // namespace tunica::output
