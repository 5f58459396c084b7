#include "tunica/base/large_pages.hpp"

#include <cstdint>

#if defined(__linux__)
#include <sys/mman.h>
#endif

namespace tunica {

void use_large_pages(const void* begin, std::size_t bytes) {
#if defined(__linux__) && defined(MADV_HUGEPAGE)
  constexpr std::uintptr_t large = std::uintptr_t(1) << 21;
  constexpr int collapse = 25;  // MADV_COLLAPSE, of Linux 6.1, which headers may not know yet
  // Whole pages within the range: neighbours in memory keep theirs.
  const auto address = reinterpret_cast<std::uintptr_t>(begin);
  const std::uintptr_t first = (address + large - 1) & ~(large - 1);
  const std::uintptr_t last = (address + bytes) & ~(large - 1);
  if (last <= first) return;
  void* const pages = reinterpret_cast<void*>(first);
  // A system that refuses leaves the pages as they are.
  if (madvise(pages, last - first, MADV_HUGEPAGE) == 0) madvise(pages, last - first, collapse);
#else
  static_cast<void>(begin);
  static_cast<void>(bytes);
#endif
}

}  // namespace tunica
