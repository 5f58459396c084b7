#pragma once
#include <string>

#include "tunica/base/types.hpp"

namespace tunica {

/// From now on SIGUSR1, which batch systems send some time before the limit of a job, is the wish
/// that the program ends where it can.
void catch_early_notice();

/// Catches SIGTERM and SIGINT, too, which are urgent (is_stop_urgent()). A second one of these ends
/// the program at once.
void catch_stop_signals();

/// Number of the signal that has expressed the wish to this rank; 0 where none has.
int stop_signal();

/// True once SIGTERM or SIGINT has reached this rank: what takes long ends before its end.
bool is_stop_urgent();

/// Ends a computation before its end, on all ranks alike. Not derived from std::exception: no
/// handler of failures shall take it for one.
struct StopRequest {
  int signal;  ///< that one rank has received
};

/// Throws StopRequest on all ranks where is_stop_urgent() on one. Collective.
void stop_if_urgent(const Comm& comm);

/// "SIGTERM"
std::string signal_name(int number);

}  // namespace tunica
