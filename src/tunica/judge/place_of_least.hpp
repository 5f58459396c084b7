#pragma once
#include <Teuchos_CommHelpers.hpp>

#include "tunica/base/reduce.hpp"
#include "tunica/base/tensor.hpp"

namespace tunica::judge {

/// Where the least of all ranks' values is: the place of the first rank that has it. Collective.
inline Vec3 place_of_least(const Comm& comm, double mine, Vec3 place) {
  const double least = global_min(comm, mine);
  const int vote = mine == least ? comm.getRank() : comm.getSize();
  const int speaker = static_cast<int>(global_min(comm, vote));
  if (speaker < comm.getSize()) Teuchos::broadcast(comm, speaker, 3, place.data());
  return place;
}

}  // namespace tunica::judge
