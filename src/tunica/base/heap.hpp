#pragma once
#include <malloc.h>

namespace tunica {

/// Bytes that the process has allocated and not given back; 0 where the C library does not tell.
inline double heap_bytes() {
#if defined(__GLIBC__) && (__GLIBC__ > 2 || __GLIBC_MINOR__ >= 33)
  const struct mallinfo2 info = mallinfo2();
  return static_cast<double>(info.uordblks + info.hblkhd);
#else
  return 0.0;
#endif
}

}  // namespace tunica
