#pragma once
#include <string>

#include "tunica/mesh/mesh.hpp"

namespace tunica::mesh {

/// Writes a mesh in the format of the file's extension: .msh (Gmsh 2.2 ASCII), .h5 (hdf5.hpp)
/// or .vtu. A failed write leaves nothing and keeps the old file.
void write(const Mesh& mesh, const std::string& path);

/// VTK's XML format, ASCII, for ParaView: tetrahedra and triangles as cells with the arrays
/// "region" and "surface" (file numbers; 0 where not applicable). The names of the numbers stand in
/// a comment.
void write_vtu(const Mesh& mesh, const std::string& path);

}  // namespace tunica::mesh
