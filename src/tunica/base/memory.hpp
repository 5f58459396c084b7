#pragma once
#include <string>
#include <utility>
#include <vector>

#include "tunica/base/types.hpp"

namespace tunica {

/// The most memory that the process has had at any moment so far [MB].
double peak_memory();
/// Peak memory of each rank. Collective.
std::vector<double> peaks_of_memory(const Comm& comm);

/// Memory of the phases of a program: peaks of the ranks.
class MemoryByPhase {
public:
  /// Collective.
  void end(const std::string& phase, const Comm& comm);
  /// In the order they ended: the peaks up to there [MB].
  const std::vector<std::pair<std::string, std::vector<double>>>& phases() const { return phases_; }

private:
  std::vector<std::pair<std::string, std::vector<double>>> phases_;
};

}  // namespace tunica
