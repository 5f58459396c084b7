#include "tunica/mesh/write.hpp"

#include <filesystem>

#include "tunica/base/error.hpp"
#include "tunica/mesh/formats/gmsh.hpp"
#include "tunica/mesh/formats/hdf5.hpp"

namespace tunica::mesh {

void write(const Mesh& mesh, const std::string& path) {
  const std::filesystem::path extension = std::filesystem::path(path).extension();
  if (extension == ".h5") return write_hdf5(mesh, path);
  if (extension == ".vtu") return write_vtu(mesh, path);
  TUNICA_CHECK(extension == ".msh",
               path + ": unknown extension, expected .h5, .msh (Gmsh 2.2) or .vtu");
  write_gmsh(mesh, path, GmshVersion::v22);
}

}  // namespace tunica::mesh
