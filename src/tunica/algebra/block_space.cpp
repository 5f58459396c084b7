#include "tunica/algebra/block_space.hpp"

#include <set>
#include <stdexcept>

namespace tunica::algebra {

BlockSpace::BlockSpace(std::vector<Block> blocks, std::vector<std::string> parts)
    : blocks_(std::move(blocks)), parts_(std::move(parts)) {
  std::set<std::string> names;
  for (const Block& block : blocks_) names.insert(block.name);
  if (names.size() != blocks_.size() || blocks_.empty())
    throw std::invalid_argument("BlockSpace: expected at least one block, all of different names");
}

int BlockSpace::index_of(const std::string& name) const {
  std::string known;
  for (int b = 0; b < n_blocks(); ++b) {
    if (blocks_[b].name == name) return b;
    known += (known.empty() ? "\"" : ", \"") + blocks_[b].name + "\"";
  }
  throw std::invalid_argument("BlockSpace: no block is named \"" + name + "\"; there are " + known);
}

long long BlockSpace::n_unknowns() const {
  long long sum = 0;
  for (const Block& block : blocks_)
    sum += static_cast<long long>(block.map->getGlobalNumElements());
  return sum;
}

}  // namespace tunica::algebra
