#include "tunica/base/stop_signals.hpp"

#include <array>
#include <csignal>

#include "tunica/base/reduce.hpp"

namespace tunica {

namespace {

volatile std::sig_atomic_t wish = 0, urgent_wishes = 0;

void take_down(int number) {
  if (wish == 0) wish = number;
  if (number == SIGUSR1) return;
  urgent_wishes = urgent_wishes + 1;
  if (urgent_wishes < 2) return;
  std::signal(number, SIG_DFL);
  std::raise(number);  // comes when this function returns
}

constexpr std::array<int, 3> all = {SIGTERM, SIGINT, SIGUSR1};

void take(int number) {
  struct sigaction action = {};
  action.sa_handler = take_down;
  action.sa_flags = SA_RESTART;
  sigemptyset(&action.sa_mask);
  for (const int masked : all) sigaddset(&action.sa_mask, masked);
  sigaction(number, &action, nullptr);
}

}  // namespace

void catch_early_notice() { take(SIGUSR1); }

void catch_stop_signals() {
  for (const int number : all) take(number);
}

int stop_signal() { return wish; }

bool is_stop_urgent() { return urgent_wishes > 0; }

void stop_if_urgent(const Comm& comm) {
  const double mine = is_stop_urgent() ? stop_signal() : 0;
  const double any = comm.getSize() == 1 ? mine : global_max(comm, mine);
  if (any > 0.0) throw StopRequest{static_cast<int>(any)};
}

std::string signal_name(int number) {
  if (number == SIGTERM) return "SIGTERM";
  if (number == SIGINT) return "SIGINT";
  if (number == SIGUSR1) return "SIGUSR1";
  return "signal " + std::to_string(number);
}

}  // namespace tunica
