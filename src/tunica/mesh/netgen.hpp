#pragma once
#include <string>

#include "tunica/mesh/mesh.hpp"

namespace tunica::mesh {

/// Reads a Netgen .vol file (text). Materials become regions, boundary conditions become
/// surfaces, with the names of the sections "materials" and "bcnames". Netgen's tetrahedra
/// are negative and are flipped. Quadratic and non-simplex elements are an Error.
Mesh read_netgen(const std::string& path);

}  // namespace tunica::mesh
