#pragma once
#include <limits>
#include <string>
#include <vector>

#include "tunica/base/types.hpp"

namespace tunica::systems {

/// Component of an unknown that does not state it: the first free one of its node.
constexpr int next_component = std::numeric_limits<int>::min();

struct Unknown {
  long long node;
  int component;   ///< 0 of a scalar
  long long line;  ///< of the file; 0 without a file
};

/// The portions of the vector and of the scalar unknowns that a rank has.
struct Unknowns {
  std::vector<Unknown> vectors, scalars;
  long long total = 0;  ///< of all ranks; may be others than expected
};

/// Reads lines of "node" or "node component", those of the vector unknowns first. Rank 0 reads so
/// many at once and hands them on. Throws the same tunica::Error on all ranks. Collective.
Unknowns read_node_map(const std::string& path, long long n_vector, long long n_scalar,
                       const CommPtr& comm, std::size_t lines_at_once);

/// Says that something is wrong in a line of the file.
std::string complaint(const std::string& path, long long line, const std::string& problem);

}  // namespace tunica::systems
