#pragma once
#include <functional>
#include <string>

#include "tunica/base/outcome.hpp"
#include "tunica/base/types.hpp"

namespace tunica {

/// The message that the ranks agree on: empty if every rank passes an empty message, otherwise the
/// message of the lowest rank that has one. The same on all ranks. Collective.
std::string agreed_message(const Comm& comm, const std::string& message);

/// Throws the same Exception on all ranks where some have a message. Collective.
template <class Exception>
void throw_if_any(const Comm& comm, const std::string& message) {
  const std::string agreed = agreed_message(comm, message);
  if (!agreed.empty()) throw Exception(agreed);
}

/// The outcome of the lowest rank that failed; success where none did. Collective.
Outcome agreed(const Comm& comm, const Outcome& mine);

/// Runs the work on rank 0 only; failures are those of on_all(). Collective.
void on_root(const Comm& comm, const std::function<void()>& work);

/// Runs work with the disk on rank 0. Where it fails or throws, all ranks throw the same
/// MachineFault. Collective.
void on_root_or_fault(const Comm& comm, const std::function<Outcome()>& work);

/// Runs the work, which is not collective, on all ranks. Where it throws Error on some, all ranks
/// throw that of the lowest; any other exception becomes a MachineFault of all. Collective.
void on_all(const Comm& comm, const std::function<void()>& work);

/// Gives every rank the text of rank 0. Collective.
void broadcast(const Comm& comm, std::string& text);

}  // namespace tunica
