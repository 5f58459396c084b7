#pragma once
#include "tunica/coupling/accelerator.hpp"
#include "unit/fields/small_tube.hpp"

namespace tunica::test {

/// The calling rank's entries of a global vector: rank r has r, r + ranks, r + 2 ranks, ...
inline coupling::InterfaceVector share(const std::vector<double>& all, const Comm& comm) {
  coupling::InterfaceVector mine;
  for (std::size_t i = comm.getRank(); i < all.size(); i += comm.getSize()) mine.push_back(all[i]);
  return mine;
}

/// The inverse of share().
inline std::vector<double> whole(const coupling::InterfaceVector& mine, std::size_t n,
                                 const Comm& comm) {
  std::vector<double> filled(n, 0.0), all(n, 0.0);
  for (std::size_t k = 0; k < mine.size(); ++k)
    filled[comm.getRank() + k * comm.getSize()] = mine[k];
  Teuchos::reduceAll(comm, Teuchos::REDUCE_SUM, static_cast<int>(n), filled.data(), all.data());
  return all;
}

}  // namespace tunica::test
