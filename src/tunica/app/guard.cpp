#include "tunica/app/guard.hpp"

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <exception>
#include <thread>

#include "tunica/base/attempt.hpp"
#include "tunica/base/error.hpp"
#include "tunica/base/failed_ranks.hpp"
#include "tunica/base/out_of_memory.hpp"
#include "tunica/io/fatal_signals.hpp"
#include "tunica/io/messages.hpp"

namespace tunica::app {

namespace {

/// How long a failed rank waits to hear of others.
constexpr std::chrono::seconds patience(2);

struct Ending {
  int status;
  std::string message;
};

[[noreturn]] void abort_all() {
  int is_running = 0;
  MPI_Initialized(&is_running);
  if (is_running != 0) MPI_Abort(MPI_COMM_WORLD, run::exit_fault);
  std::_Exit(run::exit_fault);
}

int end(const Comm& comm, const Ending& ending) {
  const int rank = comm.getRank(), size = comm.getSize();
  const auto all = told_by_failed_ranks(comm, Tidings::ending, ending.status, patience);
  const bool have_all_failed = std::count(all.begin(), all.end(), 0) == 0;
  const auto speaker = std::max_element(all.begin(), all.end()) - all.begin();
  const std::string mine = "rank " + std::to_string(rank);
  const bool is_named = have_all_failed || ending.message.find(mine) != std::string::npos;
  if (speaker == rank)
    io::print_error_line(ending.message + (is_named ? "" : " (on " + mine + " alone)"));
  const int worst = static_cast<int>(all[speaker]);
  if (have_all_failed && worst != run::exit_fault) return worst;
  if (size == 1) return run::exit_fault;
  if (speaker != rank) std::this_thread::sleep_for(patience);  // it speaks before all end
  abort_all();
}

/// Of an exception that is on its way.
Ending ending_of() {
  try {
    throw;
  } catch (const Error& error) {
    return {run::exit_bad_input, error.what()};
  } catch (const MachineFault& fault) {
    return {run::exit_fault, fault.what()};
  } catch (const std::exception& error) {
    return {run::exit_fault, is_out_of_memory(error) ? out_of_memory_text() : words_of_exception()};
  } catch (...) {
    return {run::exit_fault, words_of_exception()};
  }
}

/// For std::set_terminate: an exception left a destructor, or met another one. Nothing can be
/// agreed, and there may be no memory for words.
[[noreturn]] void terminated() {
  try {
    if (std::current_exception()) throw;
  } catch (const std::exception& error) {
    io::print_last_words("tunica: ended in", error.what());
  } catch (...) {
  }
  abort_all();
}

/// MPI's own way to fail ends a program with a status of its own.
void mpi_failed(MPI_Comm*, int* code, ...) {
  char text[MPI_MAX_ERROR_STRING] = "";
  int length = 0;
  MPI_Error_string(*code, text, &length);
  io::print_last_words("tunica: ended in MPI", text);
  abort_all();
}

/// The status of a program, and a fault of the machine where its words are lost.
int with_output(const std::string& program, int status) {
  const std::string lost = io::lost_output();
  if (lost.empty()) return status;
  io::print_error_line(program + ": " + lost);
  return status == run::exit_done ? run::exit_fault : status;
}

void watch_ends(const std::string& program, int rank) {
  std::signal(SIGXFSZ, SIG_IGN);  // a file that may not grow is a write that fails
  io::catch_fatal_signals(program, rank, run::exit_fault);
  set_memory_aside();
  std::set_terminate(terminated);
  MPI_Errhandler handler;
  MPI_Comm_create_errhandler(mpi_failed, &handler);
  MPI_Comm_set_errhandler(MPI_COMM_WORLD, handler);
}

}  // namespace

int guarded(const std::string& program, const Comm& comm, const std::function<int()>& work) {
  watch_ends(program, comm.getRank());
  side_channel(comm);
  try {
    return with_output(program, work());
  } catch (...) {
    Ending ending = ending_of();
    ending.message = program + ": " + ending.message;
    return end(comm, ending);
  }
}

}  // namespace tunica::app
