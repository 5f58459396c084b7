#pragma once
#include <string>

namespace tunica {

/// From now on SIGUSR1, which batch systems send some time before the limit of a job, is the wish
/// that the program ends where it can.
void catch_early_notice();

/// The same for SIGTERM and SIGINT, too. A second one of these ends the program at once.
void catch_stop_signals();

/// Number of the signal that has expressed the wish to this rank; 0 where none has.
int stop_signal();

/// "SIGTERM"
std::string signal_name(int number);

}  // namespace tunica
