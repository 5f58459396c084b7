#pragma once

namespace tunica::run {

/// Exit statuses of the drivers.
constexpr int exit_done = 0;
constexpr int exit_bad_input = 1;          ///< the user's input or data is wrong
constexpr int exit_not_converged = 2;      ///< a diagnosis and the steps before are on disk
constexpr int exit_fault = 3;              ///< ours, or of the machine
constexpr int exit_stopped = 5;            ///< by a signal or the wall limit, at a checkpoint
constexpr int exit_unconverged_steps = 4;  ///< done, but steps were accepted that did not converge

}  // namespace tunica::run
