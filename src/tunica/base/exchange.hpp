#pragma once
#include <mpi.h>

#include <cstddef>
#include <type_traits>
#include <vector>

#include "tunica/base/types.hpp"

namespace tunica {

/// Items from all ranks: those of rank r are counts[r] many, behind those of the ranks before.
template <class Item>
struct Received {
  std::vector<Item> items;
  std::vector<int> counts;
};

/// The communicator in MPI's terms; MPI_COMM_SELF where it has a single rank without MPI.
MPI_Comm mpi_comm(const Comm& comm);

/// Turns the numbers of items that each rank will receive from this one into the numbers that this
/// one receives. Collective.
std::vector<int> exchange_counts(const Comm& comm, const std::vector<int>& outgoing);
/// Moves bytes in items of this size. Collective.
void exchange_items(const Comm& comm, const void* outgoing, const std::vector<int>& to,
                    void* incoming, const std::vector<int>& from, std::size_t size);

/// Sends to rank r the counts[r] items behind those of the ranks before. A rank receives at most
/// 2³¹ items. Collective.
template <class Item>
Received<Item> exchange(const Comm& comm, const std::vector<Item>& items,
                        const std::vector<int>& counts) {
  static_assert(std::is_trivially_copyable_v<Item>);
  Received<Item> received{{}, exchange_counts(comm, counts)};
  std::size_t total = 0;
  for (const int count : received.counts) total += static_cast<std::size_t>(count);
  received.items.resize(total);
  exchange_items(comm, items.data(), counts, received.items.data(), received.counts, sizeof(Item));
  return received;
}

/// Exchanges items in any order: item k goes to rank ranks[k]; those for one rank keep their order.
/// Collective.
template <class Item>
Received<Item> exchange_to(const Comm& comm, const std::vector<Item>& items,
                           const std::vector<int>& ranks) {
  std::vector<int> counts(comm.getSize(), 0);
  for (const int r : ranks) ++counts[r];
  std::vector<std::size_t> next(counts.size(), 0);
  for (std::size_t r = 1; r < counts.size(); ++r)
    next[r] = next[r - 1] + static_cast<std::size_t>(counts[r - 1]);
  std::vector<Item> ordered(items.size());
  for (std::size_t k = 0; k < items.size(); ++k) ordered[next[ranks[k]]++] = items[k];
  return exchange(comm, ordered, counts);
}

}  // namespace tunica
