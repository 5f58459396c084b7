#pragma once
#include <string>

#include "tunica/mesh/distributed/row_stream.hpp"
#include "tunica/mesh/mesh.hpp"

namespace tunica::mesh {

/// Reads Gmsh MSH 2.2 or 4.1, ASCII. Points and lines are skipped; elements other than
/// 4-node tetrahedra and 3-node triangles are an Error. Negative physical numbers, by which
/// Gmsh reverses an orientation, count as positive.
void read_gmsh(const std::string& path, RowStream& rows);

enum class GmshVersion { v22, v41 };

/// Writes Gmsh ASCII. In 4.1 each region and each surface becomes one entity.
void write_gmsh(const Mesh& mesh, const std::string& path, GmshVersion version);

}  // namespace tunica::mesh
