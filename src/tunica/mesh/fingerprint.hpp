#pragma once
#include <string>

#include "tunica/mesh/mesh.hpp"

namespace tunica::mesh {

/// 16 hexadecimal digits that differ where positions, tetrahedra, regions or boundary triangles
/// differ. Names do not count, nor does the format of the file.
std::string fingerprint(const Mesh& mesh);

}  // namespace tunica::mesh
