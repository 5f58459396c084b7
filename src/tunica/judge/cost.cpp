#include "tunica/judge/cost.hpp"

#include <cmath>

#include "tunica/base/formatted.hpp"
#include "tunica/base/reduce.hpp"

namespace tunica::judge {

namespace {

constexpr double program = 114.0;                   // m₀ [MB]
constexpr double per_tetrahedron = 1.9e-3;          // m₁ [MB]
constexpr double seconds_per_tetrahedron = 2.2e-5;  // s₁

std::string size(double megabytes) {
  return megabytes < 1000.0 ? formatted("%.0f MB", 10.0 * std::round(0.1 * megabytes))
                            : formatted("%.1f GB", megabytes / 1024.0);
}

}  // namespace

Cost expected_cost(const fields::FieldMesh& mesh) {
  const auto mine = static_cast<double>(mesh.tets.size());
  const double largest = global_max(*mesh.comm, mine), all = global_sum(*mesh.comm, mine);
  return {program + per_tetrahedron * largest,
          program * mesh.comm->getSize() + per_tetrahedron * all,
          seconds_per_tetrahedron * largest};
}

std::string text_of(const Cost& cost, int ranks) {
  std::string memory = "memory: about " + size(cost.memory_of_rank);
  if (ranks > 1)
    memory += formatted(" on a rank, %s on all %d", size(cost.memory_of_all).c_str(), ranks);
  return memory + formatted(
                      ", accurate to 9 %%; a step: roughly %.2g s "
                      "with a core for each rank, off by up to a factor of 2 there",
                      cost.seconds_of_step);
}

}  // namespace tunica::judge
