#pragma once
#include <functional>
#include <string>

#include "tunica/mesh/distributed/row_stream.hpp"
#include "tunica/mesh/mesh.hpp"

namespace tunica::mesh {

/// Reads a mesh: Gmsh MSH 2.2 or 4.1 (ASCII), Netgen .vol, or tunica's HDF5 file. The
/// content decides, not the file's name. The result has passed validate(); everything else
/// is an Error that names the file and the line (text) or the dataset (HDF5).
Mesh read(const std::string& path);

/// The reader for a mesh of another program, chosen by the content of the file. Throws Error if it
/// is none.
std::function<void(RowStream&)> text_reader(const std::string& path);

/// True if read() treats the file as tunica's own format.
bool is_hdf5(const std::string& path);

}  // namespace tunica::mesh
