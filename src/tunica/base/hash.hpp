#pragma once
#include <array>
#include <cinttypes>
#include <cstddef>
#include <cstdio>
#include <string>

namespace tunica {

constexpr std::uint64_t hash_start = 14695981039346656037ULL;

/// Hash of bytes behind those that gave `hash` (FNV-1a, 64 bits). It guards against accidents,
/// not against intent.
inline std::uint64_t hash_bytes(const void* bytes, std::size_t count,
                                std::uint64_t hash = hash_start) {
  const auto* byte = static_cast<const unsigned char*>(bytes);
  for (std::size_t i = 0; i < count; ++i) hash = (hash ^ byte[i]) * 1099511628211ULL;
  return hash;
}

/// 16 hexadecimal digits.
inline std::string hash_digits(std::uint64_t hash) {
  std::array<char, 17> digits{};
  std::snprintf(digits.data(), digits.size(), "%016" PRIx64, hash);
  return digits.data();
}

}  // namespace tunica
