#pragma once
#include <Teuchos_CommHelpers.hpp>
#include <algorithm>
#include <vector>

#include "tunica/base/exchange.hpp"
#include "tunica/base/portion.hpp"

/// Arrays of which the ranks hold equal portions of rows, see portion.hpp.
namespace tunica {

/// Ascending rows, counted by the rank that has them.
template <class Number>
std::vector<int> rows_by_rank(const Comm& comm, const std::vector<Number>& rows, long long total) {
  std::vector<int> counts;
  auto from = rows.begin();
  for (int r = 0; r < comm.getSize(); ++r) {
    const auto to = std::lower_bound(from, rows.end(), first_row(total, r + 1, comm.getSize()));
    counts.push_back(static_cast<int>(to - from));
    from = to;
  }
  return counts;
}

/// Takes rows from where they are, in a row from first on, to where they belong. Rows of several
/// calls follow in the order of their numbers. Collective.
template <class Item>
std::vector<Item> spread(const Comm& comm, const std::vector<Item>& items, long long first,
                         long long total) {
  const long long end = first + static_cast<long long>(items.size());
  std::vector<int> counts;
  for (int r = 0; r < comm.getSize(); ++r)
    counts.push_back(
        static_cast<int>(std::max(0LL, std::min(end, first_row(total, r + 1, comm.getSize())) -
                                           std::max(first, first_row(total, r, comm.getSize())))));
  return exchange(comm, items, counts).items;
}

/// Brings all rows to rank 0. Collective.
template <class Item>
std::vector<Item> gather_rows(const Comm& comm, const std::vector<Item>& items) {
  std::vector<int> counts(comm.getSize(), 0);
  counts[0] = static_cast<int>(items.size());
  return exchange(comm, items, counts).items;
}

/// What rank 0 has, on all ranks. Collective.
inline std::vector<long long> on_all_ranks(const Comm& comm, std::vector<long long> of_root) {
  int count = static_cast<int>(of_root.size());
  Teuchos::broadcast(comm, 0, 1, &count);
  of_root.resize(count);
  Teuchos::broadcast(comm, 0, count, of_root.data());
  return of_root;
}

/// The items of these ascending rows. mine: those of the calling rank. Collective.
template <class Item, class Number>
std::vector<Item> fetch(const Comm& comm, const std::vector<Number>& rows,
                        const std::vector<Item>& mine, long long total) {
  const Received<Number> asked = exchange(comm, rows, rows_by_rank(comm, rows, total));
  const long long first = first_row(total, comm.getRank(), comm.getSize());
  std::vector<Item> answers;
  answers.reserve(asked.items.size());
  for (const Number row : asked.items) answers.push_back(mine[row - first]);
  return exchange(comm, answers, asked.counts).items;
}

/// Place of a number among ascending ones that differ; -1 where it is none of them.
template <class Number>
int place_of(Number number, const std::vector<Number>& ascending) {
  if (ascending.empty() || number < ascending.front()) return -1;
  // Mostly they follow each other without gaps.
  const auto guess = static_cast<std::size_t>(number - ascending.front());
  if (guess < ascending.size() && ascending[guess] == number) return static_cast<int>(guess);
  const auto found = std::lower_bound(ascending.begin(), ascending.end(), number);
  return found != ascending.end() && *found == number ? static_cast<int>(found - ascending.begin())
                                                      : -1;
}

}  // namespace tunica
