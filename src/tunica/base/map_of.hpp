#pragma once
#include <vector>

#include "tunica/base/types.hpp"

namespace tunica {

/// The map of the numbers that each rank names. Collective.
inline Teuchos::RCP<const Map> map_of(const std::vector<GlobalOrdinal>& numbers,
                                      const CommPtr& comm) {
  const auto unknown = Teuchos::OrdinalTraits<Tpetra::global_size_t>::invalid();
  return Teuchos::rcp(new Map(unknown, Teuchos::arrayViewFromVector(numbers), 0, comm));
}

}  // namespace tunica
