#pragma once
#include <Teuchos_CommHelpers.hpp>
#include <vector>

#include "tunica/base/types.hpp"

namespace tunica {

inline double global_sum(const Comm& comm, double mine) {
  double sum = 0.0;
  Teuchos::reduceAll(comm, Teuchos::REDUCE_SUM, 1, &mine, &sum);
  return sum;
}
inline long long global_sum(const Comm& comm, long long mine) {
  long long sum = 0;
  Teuchos::reduceAll(comm, Teuchos::REDUCE_SUM, 1, &mine, &sum);
  return sum;
}
/// Over the ranks below this one.
inline long long sum_before(const Comm& comm, long long mine) {
  long long up_to_here = 0;
  Teuchos::scan(comm, Teuchos::REDUCE_SUM, 1, &mine, &up_to_here);
  return up_to_here - mine;
}
/// The sums of each number over the ranks, which all have as many.
inline std::vector<double> global_sum(const Comm& comm, const std::vector<double>& mine) {
  std::vector<double> sums(mine.size(), 0.0);
  Teuchos::reduceAll(comm, Teuchos::REDUCE_SUM, static_cast<int>(mine.size()), mine.data(),
                     sums.data());
  return sums;
}
inline double global_max(const Comm& comm, double mine) {
  double largest = 0.0;
  Teuchos::reduceAll(comm, Teuchos::REDUCE_MAX, 1, &mine, &largest);
  return largest;
}
inline double global_min(const Comm& comm, double mine) { return -global_max(comm, -mine); }

/// True where it is true on every rank.
inline bool all_agree(const Comm& comm, bool mine) { return global_min(comm, mine ? 1 : 0) > 0.5; }

}  // namespace tunica
