#include "tunica/base/failed_ranks.hpp"

#include <algorithm>
#include <array>
#include <exception>
#include <thread>

#include "tunica/base/attempt.hpp"
#include "tunica/base/exception_summary.hpp"
#include "tunica/base/fault_point.hpp"
#include "tunica/base/hash.hpp"

namespace tunica {

namespace {

/// How much later than others a rank may come to what all do.
constexpr std::chrono::seconds patience_with_slow_ranks(10);

/// Of what is being handled, and where.
std::uint64_t hash_of_exception(int stage) {
  const std::string text =
      words_of_exception() + " (" + last_fault_point() + ", " + std::to_string(stage) + ")";
  return hash_bytes(text.data(), text.size());
}

bool do_all_fail_alike(const Comm& comm, int stage) {
  const std::uint64_t mine = hash_of_exception(stage);
  const auto all = told_by_failed_ranks(comm, Tidings::exception, mine, patience_with_slow_ranks);
  return std::all_of(all.begin(), all.end(), [mine](std::uint64_t one) { return one == mine; });
}

}  // namespace

std::vector<std::uint64_t> told_by_failed_ranks(const Comm& comm, Tidings what, std::uint64_t mine,
                                                std::chrono::seconds limit) {
  const MPI_Comm channel = side_channel(comm);
  if (channel == MPI_COMM_NULL) return {mine};
  static std::array<std::uint64_t, 3> sent{};  // by tag, to ranks that may never take it
  const int tag = static_cast<int>(what), rank = comm.getRank(), size = comm.getSize();
  sent.at(tag) = mine;
  std::vector<std::uint64_t> all(size, 0);
  all[rank] = mine;
  for (int to = 0; to < size; ++to) {
    MPI_Request unused = MPI_REQUEST_NULL;
    if (to != rank) MPI_Isend(&sent.at(tag), 1, MPI_UINT64_T, to, tag, channel, &unused);
  }
  const auto end = std::chrono::steady_clock::now() + limit;
  for (int heard = 1; heard < size && std::chrono::steady_clock::now() < end;) {
    int is_there = 0;
    MPI_Status envelope;
    MPI_Iprobe(MPI_ANY_SOURCE, tag, channel, &is_there, &envelope);
    if (is_there != 0) {
      MPI_Recv(&all[envelope.MPI_SOURCE], 1, MPI_UINT64_T, envelope.MPI_SOURCE, tag, channel,
               MPI_STATUS_IGNORE);
      ++heard;
    } else {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  }
  return all;
}

std::string words_of_exception() {
  try {
    throw;
  } catch (const std::exception& error) {
    return exception_summary(error.what());
  } catch (const char* message) {  // NOX throws plain strings
    return message;
  } catch (...) {
    return exception_summary("");
  }
}

void do_if_all_fail_alike(const Comm& comm, int stage, const std::function<void()>& work) {
  const KeepsLastFaultPoint place;
  try {
    if (!do_all_fail_alike(comm, stage)) return;
    work();
    comm.barrier();  // what comes next has less patience
  } catch (...) {    // what happened first is what counts
  }
}

}  // namespace tunica
