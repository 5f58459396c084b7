#pragma once
#include <string>
#include <vector>

#include "tunica/base/exchange.hpp"
#include "tunica/mesh/distributed/partition_slab.hpp"
#include "tunica/mesh/excerpt.hpp"

namespace tunica::mesh {

/// Gives ranks the values at vertices that others own.
class GhostValues {
public:
  GhostValues() = default;
  /// owner and number of each vertex that the rank knows, by ascending numbers. Collective.
  GhostValues(const CommPtr& comm, const std::vector<int>& owner, const std::vector<int>& numbers);

  /// Replaces those at the vertices of others by what their owners have. Collective.
  template <class Item>
  void update(std::vector<Item>& values) const {
    std::vector<Item> outgoing, incoming(ghosts_.size());
    outgoing.reserve(sent_.size());
    for (const int v : sent_) outgoing.push_back(values[v]);
    exchange_items(*comm_, outgoing.data(), to_, incoming.data(), from_, sizeof(Item));
    for (std::size_t k = 0; k < ghosts_.size(); ++k) values[ghosts_[k]] = incoming[k];
  }

private:
  CommPtr comm_;
  std::vector<int> sent_, ghosts_;  ///< vertices of the rank, by the rank at the other end
  std::vector<int> to_, from_;      ///< how many of them for each rank
};

/// The part of a mesh on one rank: the vertices it owns, all tetrahedra around them and those of
/// its part, and all vertices of these. Vertices and tetrahedra are in the order of the whole mesh.
/// It has all triangles at its own vertices and on tetrahedra of its part.
struct Share {
  CommPtr comm;
  Mesh mesh;                                       ///< numbers of its own; all tags
  Excerpt::Numbers numbers;                        ///< in the whole
  std::vector<char> is_owned;                      ///< per vertex
  std::vector<int> tet_part;                       ///< per tetrahedron: the rank that counts it
  std::vector<std::array<int, 2>> regions_beside;  ///< per triangle; -1 for none
  long long tets = 0;                              ///< of the whole
  GhostValues ghosts;                              ///< of vertices

  /// The rank's responsibility: faces and triangles whose lowest vertex it owns.
  Excerpt excerpt() const { return {mesh, is_owned, numbers}; }
  bool counts(std::size_t tet) const { return tet_part[tet] == comm->getRank(); }
  /// True if a triangle bounds the part of the mesh that these regions fill. is_in: per region.
  bool is_between(std::size_t triangle, const std::vector<char>& is_in) const {
    const auto& [a, b] = regions_beside[triangle];
    return (a >= 0 && is_in[a] != 0) != (b >= 0 && is_in[b] != 0);
  }
};

/// Takes every row to the ranks that need it, and checks on the way what validate() checks beyond
/// rows: shapes of tetrahedra, faces, what triangles cover. Throws Error that begins with name on
/// all ranks alike. The slab is used up. Collective.
Share distribute(Slab slab, const SlabPartition& partition, const std::string& name);

/// The two steps before and this one, for those who need nothing between them: finds the fields of
/// vertices, cuts, distributes. Throws as they do. Collective.
Share share_of(Slab slab, const std::vector<bool>& region_is_fluid, Partitioner by,
               const std::string& name);

/// Checks a share as check_interface() checks a whole mesh. Throws Error on all ranks alike.
/// Collective.
void check_interface(const Share& share, const std::vector<std::string>& fluid,
                     const std::vector<std::string>& wall,
                     const std::vector<std::string>& interface);

/// In these regions (indices into mesh.regions): 1, in others: 0.
std::vector<char> marked_regions(const Mesh& mesh, const std::vector<int>& regions);

}  // namespace tunica::mesh
