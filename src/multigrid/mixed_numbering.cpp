#include "multigrid/mixed_numbering.hpp"

#include <algorithm>
#include <vector>

namespace tunica::multigrid {

namespace {

Teuchos::RCP<const Map> map_of(const std::vector<GlobalOrdinal>& numbers, const CommPtr& comm) {
  const auto unknown = Teuchos::OrdinalTraits<Tpetra::global_size_t>::invalid();
  return Teuchos::rcp(new Map(unknown, Teuchos::arrayViewFromVector(numbers), 0, comm));
}

}  // namespace

Teuchos::RCP<const Map> MixedNumbering::mixed_map(const Map& vectors, const Map& scalars) const {
  std::vector<GlobalOrdinal> numbers;
  for (const GlobalOrdinal number : vectors.getNodeElementList())
    numbers.push_back(of_vector(number));
  for (const GlobalOrdinal node : scalars.getNodeElementList()) numbers.push_back(of_scalar(node));
  std::sort(numbers.begin(), numbers.end());
  return map_of(numbers, vectors.getComm());
}

Teuchos::RCP<const Map> MixedNumbering::block_map(const Map& mixed, bool of_scalars) const {
  std::vector<GlobalOrdinal> numbers;
  for (const GlobalOrdinal number : mixed.getNodeElementList())
    if (is_scalar(number) == of_scalars) numbers.push_back(in_block(number));
  return map_of(numbers, mixed.getComm());
}

}  // namespace tunica::multigrid
