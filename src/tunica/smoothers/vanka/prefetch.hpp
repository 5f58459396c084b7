#pragma once
#include <cstddef>

namespace tunica::smoothers {

/// A range of memory that will be needed soon.
struct PrefetchRange {
  const void* from = nullptr;
  std::size_t bytes = 0;
};

/// Asks for the parts first .. last-1 of n of it without waiting: only as far as the second cache,
/// where a first of 32 kB would have to give way to it.
inline void prefetch(const PrefetchRange& ahead, int first, int last, int n) {
  const char* const from = static_cast<const char*>(ahead.from);
  const std::size_t end = ahead.bytes * last / n;
  for (std::size_t i = ahead.bytes * first / n; i < end; i += 64)
    __builtin_prefetch(from + i, 0, 2);
}

}  // namespace tunica::smoothers
