#pragma once
#include <string>

namespace tunica::run {

/// Segmentation faults and aborts, by which some libraries end where malloc() fails, become one
/// message, as far as there is one the backtrace of those who caught them before, and exit_fault.
/// The launcher of MPI programs then ends the other ranks.
void catch_fatal_signals(const std::string& program, int rank);

/// Where it lives longer than so many seconds each rank that waits says these words and ends the
/// program, as with a fatal signal.
class Deadline {
public:
  Deadline(unsigned seconds, const std::string& words);
  ~Deadline();
  Deadline(const Deadline&) = delete;
  Deadline& operator=(const Deadline&) = delete;
};

}  // namespace tunica::run
