#include "tunica/io/fatal_signals.hpp"

#include <unistd.h>

#include <array>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <string>

#include "tunica/base/fault_point.hpp"

namespace tunica::io {

namespace {

constexpr std::array<int, 3> fatal{SIGSEGV, SIGBUS, SIGABRT};
constexpr unsigned backtrace_seconds = 3;

/// What the handler needs: it must not allocate.
struct Prepared {
  std::array<char, 80> beginning{};
  std::array<struct sigaction, fatal.size()> before{};
  std::array<char, 65536> stack{};  ///< the other one may be at its end
  std::string words;                ///< of a Deadline
  int rank = 0, exit_status = 1;
};

Prepared& prepared() {
  static Prepared all;
  return all;
}

void print(const char* text) {
  if (::write(STDERR_FILENO, text, std::strlen(text)) < 0) return;  // nobody to tell
}

void give_up(int) { ::_exit(prepared().exit_status); }

void end_late(int) {
  if (prepared().rank > 0) ::sleep(1);  // of several that wait one speaks, and its end ends all
  print(prepared().beginning.data());
  print(prepared().words.c_str());
  print("\n");
  ::_exit(prepared().exit_status);
}

void handle(int signal, siginfo_t* info, void* context) {
  print(prepared().beginning.data());
  print(signal == SIGABRT ? "a library aborted" : "a segmentation fault");
  print(", as libraries do where memory is short; last passed: ");
  print(last_fault_point());
  print("\n");
  std::signal(SIGALRM, give_up);  // the backtrace may wait for the heap
  ::alarm(backtrace_seconds);
  for (std::size_t k = 0; k < fatal.size(); ++k) {
    const struct sigaction& before = prepared().before[k];
    if (fatal[k] == signal && (before.sa_flags & SA_SIGINFO) != 0 && before.sa_sigaction != nullptr)
      before.sa_sigaction(signal, info, context);
  }
  ::_exit(prepared().exit_status);
}

}  // namespace

void catch_fatal_signals(const std::string& program, int rank, int exit_status) {
  Prepared& mine = prepared();
  std::snprintf(mine.beginning.data(), mine.beginning.size(), "%s: rank %d: ", program.c_str(),
                rank);
  mine.rank = rank;
  mine.exit_status = exit_status;
#ifdef __SANITIZE_ADDRESS__
  static_cast<void>(handle);  // the sanitizer tells more
#else
  stack_t stack{};
  stack.ss_sp = mine.stack.data();
  stack.ss_size = mine.stack.size();
  ::sigaltstack(&stack, nullptr);
  struct sigaction action = {};
  action.sa_sigaction = handle;
  action.sa_flags = SA_SIGINFO | SA_ONSTACK;
  for (std::size_t k = 0; k < fatal.size(); ++k) ::sigaction(fatal[k], &action, &mine.before[k]);
#endif
}

Deadline::Deadline(unsigned seconds, const std::string& words)
    : outer_words_(prepared().words), outer_seconds_(::alarm(0)) {
  prepared().words = words;
  std::signal(SIGALRM, end_late);
  ::alarm(seconds);
}

Deadline::~Deadline() {
  ::alarm(0);
  prepared().words = outer_words_;
  ::alarm(outer_seconds_);
}

}  // namespace tunica::io
