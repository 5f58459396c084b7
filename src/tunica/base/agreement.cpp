#include "tunica/base/agreement.hpp"

#include <Teuchos_CommHelpers.hpp>

#include "tunica/base/error.hpp"
#include "tunica/base/out_of_memory.hpp"

namespace tunica {

namespace {

void broadcast_from(const Comm& comm, int speaker, std::string& text) {
  int length = static_cast<int>(text.size());
  Teuchos::broadcast(comm, speaker, 1, &length);
  text.resize(static_cast<std::size_t>(length));
  Teuchos::broadcast(comm, speaker, length, text.data());
}

std::string reason_of(const std::exception& error) {
  return is_out_of_memory(error) ? out_of_memory_text() : error.what();
}

}  // namespace

Outcome agreed(const Comm& comm, const Outcome& mine) {
  const int vote = mine.is_success() ? comm.getSize() : comm.getRank();
  int speaker = comm.getSize();
  Teuchos::reduceAll(comm, Teuchos::REDUCE_MIN, 1, &vote, &speaker);
  if (speaker == comm.getSize()) return Outcome::success();
  std::string reason = mine.reason();
  broadcast_from(comm, speaker, reason);
  return Outcome::failure(reason);
}

std::string agreed_message(const Comm& comm, const std::string& message) {
  return agreed(comm, message.empty() ? Outcome::success() : Outcome::failure(message)).reason();
}

void on_root(const Comm& comm, const std::function<void()>& work) {
  on_all(comm, [&] {
    if (comm.getRank() == 0) work();
  });
}

void on_root_or_fault(const Comm& comm, const std::function<Outcome()>& work) {
  Outcome outcome = Outcome::success();
  try {
    if (comm.getRank() == 0) outcome = work();
  } catch (const std::exception& error) {
    outcome = Outcome::failure(reason_of(error));
  }
  outcome = agreed(comm, outcome);
  if (outcome.is_failure()) throw MachineFault(outcome.reason());
}

void on_all(const Comm& comm, const std::function<void()>& work) {
  Outcome input = Outcome::success(), machine = Outcome::success();
  try {
    work();
  } catch (const Error& error) {
    input = Outcome::failure(error.what());
  } catch (const std::exception& error) {
    machine = Outcome::failure(reason_of(error));
  }
  machine = agreed(comm, machine);
  if (machine.is_failure()) throw MachineFault(machine.reason());
  input = agreed(comm, input);
  TUNICA_CHECK(input.is_success(), input.reason());
}

void broadcast(const Comm& comm, std::string& text) { broadcast_from(comm, 0, text); }

}  // namespace tunica
