#include "tunica/systems/node_table.hpp"

#include <algorithm>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <string>

#include "tunica/base/error.hpp"

namespace tunica::systems {

namespace {

void find_shared(NodeTable& table) {
  std::vector<char> has(table.n_nodes, 0);
  for (const long long node : table.vector_node) has[node] |= 1;
  for (const long long node : table.scalar_node) has[node] |= 2;
  table.is_shared = std::none_of(has.begin(), has.end(), [](char h) { return h == 1 || h == 2; });
}

/// Nodes get the numbers 0, 1, … in the order of those of the file.
void close_gaps(NodeTable& table) {
  std::vector<long long> nodes = table.vector_node;
  nodes.insert(nodes.end(), table.scalar_node.begin(), table.scalar_node.end());
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  for (auto* const list : {&table.vector_node, &table.scalar_node})
    for (long long& node : *list)
      node = std::lower_bound(nodes.begin(), nodes.end(), node) - nodes.begin();
  table.n_nodes = static_cast<long long>(nodes.size());
}

NodeTable regular(int components, bool is_by_node, long long n_vector, long long n_scalar) {
  TUNICA_CHECK(n_vector % components == 0,
               "System: A has " + std::to_string(n_vector) +
                   " rows, which \"components\" = " + std::to_string(components) +
                   " does not divide. A \"node map\" says what belongs together.");
  NodeTable table;
  table.components = components;
  const long long n = n_vector / components;
  for (long long k = 0; k < n_vector; ++k) {
    table.vector_node.push_back(is_by_node ? k / components : k % n);
    table.component.push_back(static_cast<int>(is_by_node ? k % components : k / n));
  }
  for (long long k = 0; k < n_scalar; ++k) table.scalar_node.push_back(k);
  return table;
}

/// Lines of "node" or "node component".
class MapFile {
public:
  MapFile(const std::string& path, int components) : path_(path), components_(components) {}

  NodeTable read(long long n_vector, long long n_scalar) {
    std::ifstream file(path_);
    NodeTable table;
    table.components = components_;
    for (std::string line; std::getline(file, line);) {
      ++line_;
      if (line.empty() || line[0] == '%' || line[0] == '#') continue;
      std::istringstream words(line);
      long long node = -1;
      int component = -1;
      const bool is_number = static_cast<bool>(words >> node);
      check(is_number && node >= 0,
            "expected the number of a node, from 0 on, found \"" + line + "\"");
      const bool is_vector = static_cast<long long>(table.vector_node.size()) < n_vector;
      const bool has_component = is_vector && static_cast<bool>(words >> component);
      words.clear();
      std::string rest;
      check(!(words >> rest), "found \"" + rest + "\" after the numbers");
      if (is_vector)
        add_vector(table, node, has_component ? component : n_on_node_[node]);
      else
        add_scalar(table, node);
    }
    const auto n_lines = static_cast<long long>(table.vector_node.size()) +
                         static_cast<long long>(table.scalar_node.size());
    TUNICA_CHECK(n_lines == n_vector + n_scalar, path_ + ": " + std::to_string(n_lines) +
                                                     " unknowns, expected " +
                                                     std::to_string(n_vector) + " of A and " +
                                                     std::to_string(n_scalar) + " of B2.");
    return table;
  }

private:
  void check(bool is_good, const std::string& problem) const {
    TUNICA_CHECK(is_good, path_ + ", line " + std::to_string(line_) + ": " + problem + ".");
  }
  void add_vector(NodeTable& table, long long node, int component) {
    check(component >= 0 && component < components_,
          "component " + std::to_string(component) + " of node " + std::to_string(node) +
              ", but \"components\" is " + std::to_string(components_));
    check(taken_.emplace(node, component).second, "node " + std::to_string(node) +
                                                      " has two unknowns of component " +
                                                      std::to_string(component));
    ++n_on_node_[node];
    table.vector_node.push_back(node);
    table.component.push_back(component);
  }
  void add_scalar(NodeTable& table, long long node) {
    check(taken_.emplace(node, components_).second,
          "node " + std::to_string(node) + " has two scalar unknowns");
    table.scalar_node.push_back(node);
  }

  std::string path_;
  int components_, line_ = 0;
  std::map<long long, int> n_on_node_;
  std::set<std::pair<long long, int>> taken_;
};

}  // namespace

NodeTable make_node_table(const Teuchos::ParameterList& options, long long n_vector,
                          long long n_scalar) {
  const int components = options.get<int>("components");
  const auto& file = options.get<std::string>("node map");
  NodeTable table =
      file.empty()
          ? regular(components, options.get<std::string>("order") == "by node", n_vector, n_scalar)
          : MapFile(file, components).read(n_vector, n_scalar);
  close_gaps(table);
  find_shared(table);
  return table;
}

}  // namespace tunica::systems
