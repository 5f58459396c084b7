#pragma once
#include <string>

namespace tunica::io {

/// Segmentation faults and aborts, by which some libraries end where malloc() fails, become one
/// message, as far as there is one the backtrace of those who caught them before, and the exit
/// status. The launcher of MPI programs then ends the other ranks.
void catch_fatal_signals(const std::string& program, int rank, int exit_status);

/// Where it lives longer than so many seconds a rank that waits says these words and ends the
/// program, as with a fatal signal: for waiting in a library that nothing else ends. One within
/// another stops the clock of that. Not for threads.
class Deadline {
public:
  Deadline(unsigned seconds, const std::string& words);
  ~Deadline();
  Deadline(const Deadline&) = delete;
  Deadline& operator=(const Deadline&) = delete;

private:
  std::string outer_words_;
  unsigned outer_seconds_;
};

}  // namespace tunica::io
