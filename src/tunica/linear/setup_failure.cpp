#include "tunica/linear/setup_failure.hpp"

#include "tunica/base/attempt.hpp"

namespace tunica::linear {

void set_up(const Comm& comm, const std::string& what, const std::function<void()>& work) {
  const Outcome outcome = attempt(comm, "setting up " + what, work);
  if (outcome.is_failure()) throw SetupFailure(what + " cannot be set up: " + outcome.reason());
}

}  // namespace tunica::linear
