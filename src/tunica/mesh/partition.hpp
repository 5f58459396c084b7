#pragma once
#include <string>
#include <vector>

#include "tunica/mesh/mesh.hpp"

namespace tunica::mesh {

/// Which part (rank) holds what.
struct Partition {
  std::vector<int> tet_part;      ///< per tetrahedron
  std::vector<int> vertex_owner;  ///< per vertex: one of the parts of its tetrahedra
};

/// Splits the mesh by METIS (graph of tetrahedra that share a face) so that every part has
/// its share of the fluid's and of the wall's tetrahedra. The same input gives the same parts.
///
/// A vertex belongs to the part that holds most of its tetrahedra (ties: the lowest part).
/// Wherever possible every part then owns a vertex of the fluid and one of the wall.
/// region_is_fluid: per region. Throws Error, beginning with name, if there are more parts than
/// tetrahedra or a face has more than two of these.
Partition partition(const Mesh& mesh, int parts, const std::vector<bool>& region_is_fluid,
                    const std::string& name = "mesh");

}  // namespace tunica::mesh
