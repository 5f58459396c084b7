#include <cstdlib>
#include <vector>

#include "tunica/mesh/formats/gmsh_reader.hpp"

namespace tunica::mesh {

int GmshReader::read_physical() {
  const long long n = in_.count("the number of an entity's physical groups", 2);
  int physical = 0;
  for (long long i = 0; i < n; ++i)
    physical = std::abs(in_.integer("the number of a physical group", -largest_int, largest_int));
  if (n > 1)
    in_.fail("the entity belongs to " + std::to_string(n) +
             " physical groups, expected at most one");
  return physical;
}

void GmshReader::read_entities_41() {
  std::array<long long, 4> counts{};
  for (long long& count : counts) count = in_.count("the number of entities", 8);
  for (int dimension = 0; dimension < 4; ++dimension) {
    for (long long i = 0; i < counts[dimension]; ++i) {
      const long long number = in_.integer("the number of an entity");
      const int coordinates = dimension == 0 ? 3 : 6;
      for (int c = 0; c < coordinates; ++c) in_.real("the bounds of an entity");
      // Points and curves of a volume may belong to several groups; they play no role.
      if (dimension >= (curves_ != nullptr ? 1 : 2)) {
        physical_of_entity_[{dimension, number}] = read_physical();
      } else {
        const long long groups = in_.count("the number of an entity's physical groups", 2);
        for (long long g = 0; g < groups; ++g) in_.integer("the number of a physical group");
      }
      if (dimension == 0) continue;
      const long long bounds = in_.count("the number of an entity's bounding entities", 2);
      for (long long b = 0; b < bounds; ++b) in_.integer("the number of a bounding entity");
    }
  }
}

std::vector<GmshReader::Run> GmshReader::read_runs(long long n) {
  std::vector<Run> runs;
  for (long long i = 0; i < n; ++i) {
    const long long number = in_.integer("the number of a node");
    if (!runs.empty() && number > runs.back().first &&
        number - 1 == runs.back().first + (runs.back().count - 1))
      ++runs.back().count;
    else
      runs.push_back({number, 1});
  }
  return runs;
}

void GmshReader::read_nodes_41() {
  const long long blocks = in_.count("the number of entity blocks", 8);
  const long long total = in_.count("the number of nodes", 8);
  in_.integer("the smallest node number");
  in_.integer("the largest node number");
  for (long long block = 0; block < blocks; ++block) {
    const int dimension = in_.integer("the dimension of an entity", 0, 3);
    in_.integer("the number of an entity");
    const int parameters = in_.integer("\"parametric\"", 0, 1) == 1 ? dimension : 0;
    const long long n = in_.count("the number of nodes in a block", 8);
    for (const auto& [first, count] : read_runs(n))
      for (long long i = 0; i < count; ++i) {
        add_node(first + i, read_point());
        for (int p = 0; p < parameters; ++p) in_.real("a parameter of a node");
      }
  }
  if (rows_.vertices.count() != total)
    in_.fail("the blocks hold " + std::to_string(rows_.vertices.count()) + " nodes, expected " +
             std::to_string(total));
}

void GmshReader::read_elements_41() {
  const long long blocks = in_.count("the number of entity blocks", 8);
  const long long total = in_.count("the number of elements", 4);
  in_.integer("the smallest element number");
  in_.integer("the largest element number");
  long long found = 0;
  for (long long block = 0; block < blocks; ++block) {
    const int dimension = in_.integer("the dimension of an entity", 0, 3);
    const long long entity = in_.integer("the number of an entity");
    const int type = in_.integer("the type of an element", 1, largest_int);
    const long long n = in_.count("the number of elements in a block", 4);
    const auto group = physical_of_entity_.find({dimension, entity});
    const int physical = group == physical_of_entity_.end() ? 0 : group->second;
    for (long long i = 0; i < n; ++i)
      read_element(in_.integer("the number of an element"), type, physical);
    found += n;
  }
  if (found != total)
    in_.fail("the blocks hold " + std::to_string(found) + " elements, expected " +
             std::to_string(total));
}

}  // namespace tunica::mesh
