#pragma once
#include <functional>
#include <stdexcept>
#include <string>

#include "tunica/base/types.hpp"

namespace tunica::linear {

/// A matrix that permits no factors or no preconditioner; on all ranks alike. A result for Newton's
/// method, not a fault.
class SetupFailure : public std::runtime_error {
public:
  using std::runtime_error::runtime_error;
};

/// Does the work that sets `what` up, as attempt() (base/attempt.hpp). Throws SetupFailure on all
/// ranks where it fails on some, MachineFault where memory runs out. Collective.
void set_up(const Comm& comm, const std::string& what, const std::function<void()>& work);

}  // namespace tunica::linear
