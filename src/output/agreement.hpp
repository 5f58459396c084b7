#pragma once
#include <string>

#include "base/types.hpp"

namespace tunica::output {

/// What the ranks agree to complain about: empty if every rank passes an empty message,
/// otherwise the message of the lowest rank that has one. The same on all ranks. Collective.
std::string agreed_message(const Comm& comm, const std::string& message);

}  // namespace tunica::output
