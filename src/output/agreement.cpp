#include "output/agreement.hpp"

#include <Teuchos_CommHelpers.hpp>

namespace tunica::output {

std::string agreed_message(const Comm& comm, const std::string& message) {
  const int mine = message.empty() ? comm.getSize() : comm.getRank();
  int speaker = comm.getSize();
  Teuchos::reduceAll(comm, Teuchos::REDUCE_MIN, 1, &mine, &speaker);
  if (speaker == comm.getSize()) return "";

  std::string text = message;
  int length = static_cast<int>(text.size());
  Teuchos::broadcast(comm, speaker, 1, &length);
  text.resize(static_cast<std::size_t>(length));
  Teuchos::broadcast(comm, speaker, length, text.data());
  return text;
}

}  // namespace tunica::output
