#pragma once
#include <string>
#include <vector>

#include "tunica/base/hash.hpp"
#include "tunica/fields/state.hpp"

namespace tunica::output {

/// Sum of the hashes of all rows with their vertices, modulo 2^64: the same in whatever order and
/// on whatever ranks the rows stand.
inline std::uint64_t checksum(const std::vector<GlobalOrdinal>& vertices,
                              const fields::State::Array& rows) {
  std::uint64_t sum = 0;
  for (std::size_t r = 0; r < vertices.size(); ++r) {
    const std::uint64_t start = hash_bytes(&vertices[r], sizeof vertices[r]);
    sum += hash_bytes(rows.values.data() + r * rows.columns, rows.columns * sizeof(double), start);
  }
  return sum;
}

/// Digits for everything in a checkpoint but its arrays.
inline std::string head_checksum(const std::vector<const std::vector<std::string>*>& texts,
                                 const std::vector<const std::vector<int>*>& integers,
                                 const std::vector<double>& numbers) {
  std::uint64_t hash = hash_start;
  for (const auto* list : texts)
    for (const std::string& text : *list) hash = hash_bytes(text.c_str(), text.size() + 1, hash);
  for (const auto* list : integers)
    hash = hash_bytes(list->data(), list->size() * sizeof(int), hash);
  return hash_digits(hash_bytes(numbers.data(), numbers.size() * sizeof(double), hash));
}

}  // namespace tunica::output
