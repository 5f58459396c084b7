#include "tunica/base/agreement.hpp"

#include <Teuchos_CommHelpers.hpp>

#include "tunica/base/error.hpp"

namespace tunica {

namespace {

void broadcast_from(const Comm& comm, int speaker, std::string& text) {
  int length = static_cast<int>(text.size());
  Teuchos::broadcast(comm, speaker, 1, &length);
  text.resize(static_cast<std::size_t>(length));
  Teuchos::broadcast(comm, speaker, length, text.data());
}

}  // namespace

std::string agreed_message(const Comm& comm, const std::string& message) {
  const int mine = message.empty() ? comm.getSize() : comm.getRank();
  int speaker = comm.getSize();
  Teuchos::reduceAll(comm, Teuchos::REDUCE_MIN, 1, &mine, &speaker);
  if (speaker == comm.getSize()) return "";
  std::string text = message;
  broadcast_from(comm, speaker, text);
  return text;
}

void on_root(const Comm& comm, const std::function<void()>& work) {
  on_all(comm, [&] {
    if (comm.getRank() == 0) work();
  });
}

void on_root_or_fault(const Comm& comm, const std::function<std::string()>& work) {
  std::string problem;
  try {
    if (comm.getRank() == 0) problem = work();
  } catch (const std::exception& error) {
    problem = error.what();
  }
  problem = agreed_message(comm, problem);
  if (!problem.empty()) throw MachineFault(problem);
}

void on_all(const Comm& comm, const std::function<void()>& work) {
  std::string message;
  try {
    work();
  } catch (const Error& error) {
    message = error.what();
  }
  message = agreed_message(comm, message);
  TUNICA_CHECK(message.empty(), message);
}

void broadcast(const Comm& comm, std::string& text) { broadcast_from(comm, 0, text); }

}  // namespace tunica
