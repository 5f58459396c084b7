#pragma once
#include "tunica/base/types.hpp"

namespace tunica {

/// The rows of one rank where all have equal portions of so many, one behind the other: who has a
/// row follows from its number.
struct Portion {
  long long first, count;
};

/// The first row of a rank; that of the rank behind the last is the total.
inline long long first_row(long long total, int rank, int ranks) { return total * rank / ranks; }

/// The rank that has a row.
inline int rank_of_row(long long row, long long total, const Comm& comm) {
  return static_cast<int>(((row + 1) * comm.getSize() - 1) / total);
}

inline Portion portion_of(long long total, int rank, int ranks) {
  const long long first = first_row(total, rank, ranks);
  return {first, first_row(total, rank + 1, ranks) - first};
}
/// The portion of the calling rank.
inline Portion portion_of(long long total, const Comm& comm) {
  return portion_of(total, comm.getRank(), comm.getSize());
}

}  // namespace tunica
