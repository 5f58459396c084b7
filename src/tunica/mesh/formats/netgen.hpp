#pragma once
#include <string>

#include "tunica/mesh/distributed/row_stream.hpp"

namespace tunica::mesh {

/// Reads a Netgen .vol file (text). Materials become regions, boundary conditions become
/// surfaces, with the names of the sections "materials" and "bcnames". Netgen's tetrahedra
/// are negative. Quadratic and non-simplex elements are an Error.
void read_netgen(const std::string& path, RowStream& rows);

}  // namespace tunica::mesh
