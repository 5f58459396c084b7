#pragma once
#include <functional>
#include <string>

#include "tunica/base/types.hpp"

namespace tunica {

/// What the ranks agree to complain about: empty if every rank passes an empty message,
/// otherwise the message of the lowest rank that has one. The same on all ranks. Collective.
std::string agreed_message(const Comm& comm, const std::string& message);

/// Runs the work on rank 0 only. Where it throws Error, all ranks throw the same. Collective.
void on_root(const Comm& comm, const std::function<void()>& work);

/// Runs work with the disk on rank 0, which returns what went wrong or throws. All ranks then throw
/// the same MachineFault. Collective.
void on_root_or_fault(const Comm& comm, const std::function<std::string()>& work);

/// Runs the work, which is not collective, on all ranks. Where it throws Error on some, all ranks
/// throw that of the lowest. Collective.
void on_all(const Comm& comm, const std::function<void()>& work);

/// Gives every rank the text of rank 0. Collective.
void broadcast(const Comm& comm, std::string& text);

}  // namespace tunica
