#pragma once
#include <functional>
#include <string>

#include "tunica/base/types.hpp"

namespace tunica::app {

/// What a driver returns to the shell.
constexpr int exit_done = 0;
constexpr int exit_bad_input = 1;          ///< the user's input or data is wrong
constexpr int exit_not_converged = 2;      ///< a diagnosis and the steps before are on disk
constexpr int exit_fault = 3;              ///< ours, or of the machine
constexpr int exit_stopped = 5;            ///< by a signal or the wall limit, at a checkpoint
constexpr int exit_unconverged_steps = 4;  ///< done, but steps were accepted that did not converge

/// Does the work of a program: the one place where exceptions become exit statuses.
///
/// What all ranks throw alike is told by one of them. A rank that fails alone leaves the others
/// waiting for it: after a moment it tells why and ends them all, with exit_fault whatever it was.
/// So do exceptions that nothing catches. Collective.
int guarded(const std::string& program, const Comm& comm, const std::function<int()>& work);

}  // namespace tunica::app
