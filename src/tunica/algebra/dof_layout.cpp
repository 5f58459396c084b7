#include "tunica/algebra/dof_layout.hpp"

#include <algorithm>
#include <vector>

#include "tunica/base/map_of.hpp"
#include "tunica/base/trilinos.hpp"

namespace tunica::algebra {

Teuchos::RCP<const Map> DofLayout::mixed_map(const Map& vectors, const Map& scalars) const {
  std::vector<GlobalOrdinal> numbers;
  for (const GlobalOrdinal number : global_numbers(vectors)) numbers.push_back(of_vector(number));
  for (const GlobalOrdinal node : global_numbers(scalars)) numbers.push_back(of_scalar(node));
  std::sort(numbers.begin(), numbers.end());
  return map_of(numbers, vectors.getComm());
}

Teuchos::RCP<const Map> DofLayout::block_map(const Map& mixed, bool of_scalars) const {
  std::vector<GlobalOrdinal> numbers;
  for (const GlobalOrdinal number : global_numbers(mixed))
    if (is_scalar(number) == of_scalars) numbers.push_back(in_block(number));
  return map_of(numbers, mixed.getComm());
}

}  // namespace tunica::algebra
