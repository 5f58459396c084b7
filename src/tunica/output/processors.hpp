#pragma once
#include <string>

#include "tunica/base/types.hpp"

namespace tunica::output {

/// Processors that a control group of Linux grants, by its file cpu.max: a quota over a period in
/// microseconds, or "max"; rounded up. 0 where it sets no limit.
int granted_processors(const std::string& cpu_max);

/// Processors of the machine with the most ranks per processor.
struct Processors {
  int ranks = 1;
  int processors = 1;  ///< on which its ranks may run, and which its container is granted
};
/// Collective.
Processors scarcest_processors(const Comm& comm);

/// A warning, or nothing: ranks that wait for others take the time of those where several share a
/// processor, unless Open MPI is told to yield it.
std::string doubt_of(const Processors& found, bool ranks_yield);
/// Whether the environment of this rank says so.
bool ranks_yield();

}  // namespace tunica::output
