#include "tunica/algebra/dof_layout.hpp"

#include <algorithm>

#include "tunica/base/map_of.hpp"
#include "tunica/base/trilinos.hpp"

namespace tunica::algebra {

namespace {

std::vector<int> components_of(const BlockSpace& space) {
  std::vector<int> components;
  for (int b = 0; b < space.n_blocks(); ++b) components.push_back(space[b].components);
  return components;
}

}  // namespace

DofLayout::DofLayout(std::vector<int> components) : components_(std::move(components)) {
  for (int b = 0; b < n_blocks(); ++b) {
    first_.push_back(dofs());
    block_of_.insert(block_of_.end(), components_[b], b);
  }
}

DofLayout::DofLayout(const BlockSpace& space) : DofLayout(components_of(space)) {}

std::vector<GlobalOrdinal> DofLayout::merged_numbers(const Map& in_block, int block) const {
  std::vector<GlobalOrdinal> numbers;
  numbers.reserve(n_local(in_block));
  for (const GlobalOrdinal number : global_numbers(in_block))
    numbers.push_back(merged(block, number));
  return numbers;
}

Teuchos::RCP<const Map> DofLayout::merged_map(const BlockSpace& space) const {
  std::vector<GlobalOrdinal> numbers;
  for (int b = 0; b < n_blocks(); ++b) {
    const std::vector<GlobalOrdinal> of_block = merged_numbers(*space[b].map, b);
    numbers.insert(numbers.end(), of_block.begin(), of_block.end());
  }
  std::sort(numbers.begin(), numbers.end());
  return map_of(numbers, space.comm());
}

Teuchos::RCP<const Map> DofLayout::block_map(const Map& merged, int block) const {
  std::vector<GlobalOrdinal> numbers;
  for (const GlobalOrdinal number : global_numbers(merged))
    if (block_of(number) == block) numbers.push_back(in_block(number));
  return map_of(numbers, merged.getComm());
}

}  // namespace tunica::algebra
