#pragma once
#include <string>

namespace tunica {

/// From now on SIGTERM, SIGINT and SIGUSR1, which batch systems send before the time is over, are
/// the wish that the program ends where it can. A second SIGTERM or SIGINT ends it at once.
void catch_stop_signals();

/// Number of the signal that has expressed the wish to this rank; 0 where none has.
int stop_signal();

/// "SIGTERM"
std::string signal_name(int number);

}  // namespace tunica
