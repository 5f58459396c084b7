#include "tunica/mesh/formats/number_tags.hpp"

namespace tunica::mesh {

std::vector<Tag> number_tags(std::map<int, std::string> names, const std::string& kind,
                             std::vector<int>& numbers) {
  std::map<int, int> position;
  for (const int id : numbers) position[id] = 0;
  std::vector<Tag> tags;
  for (auto& [id, at] : position) {
    at = static_cast<int>(tags.size());
    const std::string& name = names[id];
    tags.push_back({id, name.empty() ? kind + "-" + std::to_string(id) : name});
  }
  for (int& id : numbers) id = position[id];
  return tags;
}

}  // namespace tunica::mesh
