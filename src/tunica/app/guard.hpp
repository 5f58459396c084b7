#pragma once
#include <functional>
#include <string>

#include "tunica/base/types.hpp"
#include "tunica/run/exit_status.hpp"

namespace tunica::app {

/// Does the work of a program: the one place where exceptions become exit statuses.
///
/// An exception that all ranks throw alike is reported by one of them. A rank that fails alone
/// leaves the others waiting for it: after a moment it reports the reason and ends them all, with
/// run::exit_fault in any case. So do exceptions that nothing catches. Collective.
int guarded(const std::string& program, const Comm& comm, const std::function<int()>& work);

}  // namespace tunica::app
