#pragma once
#include <string>

#include "tunica/mesh/mesh.hpp"
#include "tunica/mesh/partition.hpp"

namespace tunica::mesh {

/// Writes a mesh in the format of the file's extension: .msh (Gmsh 2.2 ASCII), .h5 (hdf5.hpp)
/// or .vtu. A failed write leaves nothing and keeps the old file. A partition is written to
/// .h5 and .vtu only; with .msh it is an Error.
void write(const Mesh& mesh, const std::string& path, const Partition* partition = nullptr);

/// VTK's XML format, ASCII, for ParaView: tetrahedra and triangles as cells with the arrays
/// "region", "surface" (file numbers; 0 where not applicable) and, if given, "part" (-1 on
/// triangles); "owner" on the points. The names of the numbers stand in a comment.
void write_vtu(const Mesh& mesh, const std::string& path, const Partition* partition = nullptr);

}  // namespace tunica::mesh
