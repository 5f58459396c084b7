#include "tunica/base/memory.hpp"

#include <sys/resource.h>

#include "tunica/base/reduce.hpp"

namespace tunica {

double peak_memory() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024.0;  // KB
}

double peak_memory(const Comm& comm) { return global_max(comm, peak_memory()); }

void MemoryByPhase::end(const std::string& phase, const Comm& comm) {
  phases_.emplace_back(phase, peak_memory(comm));
}

}  // namespace tunica
