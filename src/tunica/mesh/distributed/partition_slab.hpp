#pragma once
#include <string>
#include <vector>

#include "tunica/mesh/distributed/slab.hpp"

namespace tunica::mesh {

/// Which rank gets what of a slab's rows.
struct SlabPartition {
  std::vector<int> tet_part;      ///< per tetrahedron of the slab
  std::vector<int> vertex_owner;  ///< per vertex of the slab: has all tetrahedra around it
};

/// How a mesh is cut into a part for each rank.
///
/// - metis: rank 0 has the whole mesh for it and cuts it as partition() does.
/// - geometric: vertices are cut by planes (recursive bisection, by Zoltan2), those of the wall and
///   the others each for themselves, so that every rank has its share of both fields whatever their
///   shapes; the parts of the wall are given to the ranks whose fluid they touch most. A
///   tetrahedron goes to the rank that owns most of its vertices. No rank sees more than its rows.
/// - automatic: metis up to 100,000 tetrahedra, geometric beyond.
enum class Partitioner { automatic, metis, geometric };

/// Names of the above in that order, as case files have them.
std::vector<std::string> partitioner_names();
/// Throws Error for another name.
Partitioner partitioner_of(const std::string& name);

/// fields: those of vertex_fields(). name: of the mesh, for messages. Throws Error on all ranks
/// alike if there are more ranks than tetrahedra. Collective.
SlabPartition partition(const Slab& slab, const std::vector<bool>& region_is_fluid,
                        const std::vector<char>& fields, Partitioner by, const std::string& name);

/// Quality of a partition.
struct Balance {
  double fluid = 1.0, wall = 1.0;  ///< most vertices of a rank over their mean: fluid, wall
  double cut = 0.0;                ///< part of the tetrahedra whose vertices have several owners
};
/// Collective.
Balance balance(const Slab& slab, const std::vector<char>& fields, const SlabPartition& partition);

}  // namespace tunica::mesh
