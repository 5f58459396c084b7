#include "tunica/judge/cost.hpp"

#include <cmath>

#include "tunica/base/formatted.hpp"
#include "tunica/base/reduce.hpp"

namespace tunica::judge {

namespace {

constexpr double program = 115.0;                        // m₀ [MB]
constexpr double per_fluid = 5.9e-3, per_wall = 0.7e-3;  // m₁, m₂ [MB]
constexpr double shared = 1.2;                           // a, on several ranks
constexpr double seconds_per_tetrahedron = 2.2e-5;       // s₁

std::string size(double megabytes) {
  return megabytes < 1000.0 ? formatted("%.0f MB", 10.0 * std::round(0.1 * megabytes))
                            : formatted("%.1f GB", megabytes / 1024.0);
}

}  // namespace

Cost expected_cost(const fields::FieldMesh& fluid, const fields::FieldMesh& wall) {
  const Comm& comm = *fluid.comm;
  const auto n_fluid = static_cast<double>(fluid.tets.size());
  const auto n_wall = static_cast<double>(wall.tets.size());
  const double mine =
      program + (comm.getSize() > 1 ? shared : 1.0) * (per_fluid * n_fluid + per_wall * n_wall);
  return {global_max(comm, mine), global_sum(comm, mine),
          seconds_per_tetrahedron * global_max(comm, n_fluid + n_wall)};
}

std::string text_of(const Cost& cost, int ranks) {
  std::string memory = "memory: about " + size(cost.memory_of_rank);
  if (ranks > 1)
    memory += formatted(" on a rank, %s on all %d", size(cost.memory_of_all).c_str(), ranks);
  return memory + formatted(
                      ", accurate to 10 %%; a step: roughly %.2g s "
                      "with a core for each rank, off by up to a factor of 2 there",
                      cost.seconds_of_step);
}

}  // namespace tunica::judge
