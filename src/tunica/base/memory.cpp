#include "tunica/base/memory.hpp"

#include <sys/resource.h>

#include <Teuchos_CommHelpers.hpp>

namespace tunica {

double peak_memory() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024.0;  // KB
}

std::vector<double> peaks_of_memory(const Comm& comm) {
  const double mine = peak_memory();
  std::vector<double> all(static_cast<std::size_t>(comm.getSize()));
  Teuchos::gatherAll(comm, 1, &mine, static_cast<int>(all.size()), all.data());
  return all;
}

void MemoryByPhase::end(const std::string& phase, const Comm& comm) {
  phases_.emplace_back(phase, peaks_of_memory(comm));
}

}  // namespace tunica
