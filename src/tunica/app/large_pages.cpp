#include "tunica/app/large_pages.hpp"

#include <cstdlib>

#if defined(__GLIBC__)
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>
#endif

namespace tunica::app {

#if defined(__GLIBC__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)

namespace {

/// Elsewhere they come unasked, or not at all: "always [madvise] never" has the present mode
/// marked.
bool are_for_who_asks() {
  std::ifstream file("/sys/kernel/mm/transparent_hugepage/enabled");
  std::string modes;
  std::getline(file, modes);
  return modes.find("[madvise]") != std::string::npos;
}

}  // namespace

// The C library asks for all that it allocates, matrices of Trilinos among them, but reads that
// wish when a program is loaded, and then only.
void use_large_pages(char** argv) {
  constexpr const char* tunables = "GLIBC_TUNABLES";
  if (std::getenv(tunables) != nullptr || std::getenv("LD_PRELOAD") != nullptr) return;
  if (!are_for_who_asks()) return;
  std::error_code error;
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", error);
  if (error || setenv(tunables, "glibc.malloc.hugetlb=1", 0) != 0) return;
  execv(program.c_str(), argv);  // comes back only where it fails, which harms nothing
}

#else

void use_large_pages(char**) {}

#endif

}  // namespace tunica::app
