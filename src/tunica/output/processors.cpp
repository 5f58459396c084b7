#include "tunica/output/processors.hpp"

#include <mpi.h>
#include <sched.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <sstream>

#include "tunica/base/exchange.hpp"
#include "tunica/base/reduce.hpp"

namespace tunica::output {

namespace {

constexpr int most_processors = CPU_SETSIZE;
using Mask = std::array<int, most_processors>;

/// On which the calling rank may run.
Mask own_mask() {
  Mask mask{};
  cpu_set_t set;
  CPU_ZERO(&set);
  if (sched_getaffinity(0, sizeof set, &set) != 0) return mask;
  for (int i = 0; i < most_processors; ++i) mask[i] = CPU_ISSET(i, &set) ? 1 : 0;
  return mask;
}

std::string cpu_max() {
  std::ifstream file("/sys/fs/cgroup/cpu.max");
  return {std::istreambuf_iterator<char>(file), {}};
}

}  // namespace

int granted_processors(const std::string& cpu_max) {
  std::istringstream words(cpu_max);
  double quota = 0.0, period = 0.0;
  if (!(words >> quota >> period) || !(quota > 0.0) || !(period > 0.0)) return 0;
  return static_cast<int>(std::ceil(quota / period));
}

Processors scarcest_processors(const Comm& comm) {
  MPI_Comm machine = MPI_COMM_NULL;
  MPI_Comm_split_type(mpi_comm(comm), MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &machine);
  Processors found;
  MPI_Comm_size(machine, &found.ranks);
  Mask mask = own_mask();
  MPI_Allreduce(MPI_IN_PLACE, mask.data(), most_processors, MPI_INT, MPI_MAX, machine);
  MPI_Comm_free(&machine);
  found.processors = static_cast<int>(std::count(mask.begin(), mask.end(), 1));
  const int granted = granted_processors(cpu_max());
  if (granted > 0) found.processors = std::min(found.processors, granted);
  found.processors = std::max(found.processors, 1);
  const double load = double(found.ranks) / found.processors;
  const double most = global_max(comm, load);
  return {static_cast<int>(global_max(comm, load == most ? double(found.ranks) : 0.0)),
          static_cast<int>(global_max(comm, load == most ? double(found.processors) : 0.0))};
}

std::string doubt_of(const Processors& found, bool ranks_yield) {
  if (found.ranks <= found.processors || ranks_yield) return "";
  return std::to_string(found.ranks) + " ranks share " + std::to_string(found.processors) +
         (found.processors == 1 ? " processor" : " processors") +
         " of a machine or container, and waiting ranks take time from computing ones. Use fewer "
         "ranks, or at least set OMPI_MCA_mpi_yield_when_idle=1 in the environment of mpirun.";
}

bool ranks_yield() {
  const char* const said = std::getenv("OMPI_MCA_mpi_yield_when_idle");
  return said != nullptr && std::string(said) != "0" && std::string(said) != "false";
}

}  // namespace tunica::output
