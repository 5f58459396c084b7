#include "multigrid/expanded_map.hpp"

#include <vector>

namespace tunica::multigrid {

Teuchos::RCP<const Map> expanded_map(const Map& nodes, int dofs) {
  std::vector<GlobalOrdinal> numbers;
  numbers.reserve(dofs * nodes.getNodeNumElements());
  for (std::size_t a = 0; a < nodes.getNodeNumElements(); ++a)
    for (int i = 0; i < dofs; ++i)
      numbers.push_back(dofs * nodes.getGlobalElement(static_cast<LocalOrdinal>(a)) + i);
  const auto unknown = Teuchos::OrdinalTraits<Tpetra::global_size_t>::invalid();
  return Teuchos::rcp(new Map(unknown, Teuchos::arrayViewFromVector(numbers), 0, nodes.getComm()));
}

}  // namespace tunica::multigrid
