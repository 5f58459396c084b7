#pragma once
#include <string>

namespace tunica::app {

/// Segmentation faults and aborts, by which some libraries end where malloc() fails, become one
/// message, as far as there is one the backtrace of those who caught them before, and exit_fault.
/// The launcher of MPI programs then ends the other ranks.
void catch_fatal_signals(const std::string& program, int rank);

}  // namespace tunica::app
