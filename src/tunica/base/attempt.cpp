#include "tunica/base/attempt.hpp"

#include <Teuchos_DefaultMpiComm.hpp>
#include <chrono>
#include <memory>
#include <thread>

#include "tunica/base/error.hpp"
#include "tunica/base/out_of_memory.hpp"

namespace tunica {

namespace {

/// How long a failed rank waits for the others, who may have more to do before they come.
constexpr std::chrono::seconds patience(3);

enum class Ending { success, failure, fault };

struct Verdict {
  Ending ending = Ending::success;
  std::string reason;
};

Verdict verdict_of(const std::string& doing, const std::function<void()>& work) {
  try {
    work();
    return {};
  } catch (const MachineFault& fault) {
    return {Ending::fault, fault.what()};
  } catch (const std::exception& error) {
    if (is_out_of_memory(error)) return {Ending::fault, out_of_memory_text() + " while " + doing};
    return {Ending::failure, error.what()};
  }
}

/// The largest number that a rank gives.
struct Ballot {
  long long mine, largest = 0;
  MPI_Request request = MPI_REQUEST_NULL;
};

/// The largest number of all ranks; nothing if they do not all come in time. Without a limit this
/// rank waits for good.
std::optional<long long> largest(MPI_Comm channel, long long mine,
                                 const std::optional<std::chrono::seconds>& limit) {
  auto ballot = std::make_unique<Ballot>(Ballot{mine});
  MPI_Iallreduce(&ballot->mine, &ballot->largest, 1, MPI_LONG_LONG, MPI_MAX, channel,
                 &ballot->request);
  int is_done = 0;
  if (!limit) {
    MPI_Wait(&ballot->request, MPI_STATUS_IGNORE);
    return ballot->largest;
  }
  const auto end = std::chrono::steady_clock::now() + *limit;
  while (is_done == 0 && std::chrono::steady_clock::now() < end) {
    MPI_Test(&ballot->request, &is_done, MPI_STATUS_IGNORE);
    if (is_done == 0) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  if (is_done != 0) return ballot->largest;
  static_cast<void>(ballot.release());  // MPI may still write there
  return {};
}

/// The worst verdict, of the lowest rank that has it.
Verdict agreed(const Comm& comm, const std::string& doing, const Verdict& mine) {
  const MPI_Comm channel = side_channel(comm);
  if (channel == MPI_COMM_NULL) return mine;
  const int size = comm.getSize(), rank = comm.getRank();
  const long long vote = static_cast<long long>(mine.ending) * size + (size - 1 - rank);
  const auto limit = mine.ending == Ending::success ? std::nullopt : std::optional(patience);
  const auto worst = largest(channel, vote, limit);
  if (!worst)
    return {Ending::fault, mine.ending == Ending::fault
                               ? mine.reason
                               : doing + " failed on rank " + std::to_string(rank) +
                                     " alone, and the others wait for it: " + mine.reason};
  Verdict verdict{static_cast<Ending>(*worst / size), mine.reason};
  if (verdict.ending == Ending::success) return verdict;
  const int speaker = size - 1 - static_cast<int>(*worst % size);
  int length = static_cast<int>(verdict.reason.size());
  MPI_Bcast(&length, 1, MPI_INT, speaker, channel);
  verdict.reason.resize(static_cast<std::size_t>(length));
  MPI_Bcast(verdict.reason.data(), length, MPI_CHAR, speaker, channel);
  return verdict;
}

int new_key() {
  int key = MPI_KEYVAL_INVALID;
  MPI_Comm_create_keyval(MPI_COMM_NULL_COPY_FN, MPI_COMM_NULL_DELETE_FN, &key, nullptr);
  return key;
}

/// A rank on its way out must not be taken for one that agrees on its work.
struct Channels {
  MPI_Comm work = MPI_COMM_NULL, leaving = MPI_COMM_NULL;
};

/// Made by the first call, as long as the communicator lives; null ones where there is one rank.
Channels channels_of(const Comm& comm) {
  const auto* const mpi = dynamic_cast<const Teuchos::MpiComm<int>*>(&comm);
  if (mpi == nullptr || comm.getSize() == 1) return {};
  static const int key = new_key();
  const MPI_Comm parent = *mpi->getRawMpiComm();
  void* kept = nullptr;
  int is_there = 0;
  MPI_Comm_get_attr(parent, key, static_cast<void*>(&kept), &is_there);
  if (is_there != 0) return *static_cast<Channels*>(kept);
  auto channels = std::make_unique<Channels>();
  MPI_Comm_dup(parent, &channels->work);
  MPI_Comm_dup(parent, &channels->leaving);
  MPI_Comm_set_attr(parent, key, channels.get());
  return *channels.release();
}

}  // namespace

MPI_Comm side_channel(const Comm& comm) { return channels_of(comm).work; }

Outcome attempt(const Comm& comm, const std::string& doing, const std::function<void()>& work) {
  side_channel(comm);  // while all are here
  const Verdict verdict = agreed(comm, doing, verdict_of(doing, work));
  if (verdict.ending == Ending::fault) throw MachineFault(verdict.reason);
  return verdict.ending == Ending::success ? Outcome::success() : Outcome::failure(verdict.reason);
}

bool all_meet(const Comm& comm) {
  const MPI_Comm channel = channels_of(comm).leaving;
  return channel == MPI_COMM_NULL || largest(channel, 0, patience).has_value();
}

}  // namespace tunica
