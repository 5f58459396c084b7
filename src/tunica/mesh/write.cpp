#include "tunica/mesh/write.hpp"

#include "tunica/base/error.hpp"
#include "tunica/mesh/gmsh.hpp"
#include "tunica/mesh/hdf5.hpp"

namespace tunica::mesh {
namespace {

bool ends_with(const std::string& text, const std::string& end) {
  return text.size() > end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

}  // namespace

void write(const Mesh& mesh, const std::string& path) {
  if (ends_with(path, ".h5")) return write_hdf5(mesh, path);
  if (ends_with(path, ".vtu")) return write_vtu(mesh, path);
  TUNICA_CHECK(ends_with(path, ".msh"),
               path + ": unknown extension, expected .h5, .msh (Gmsh 2.2) or .vtu");
  write_gmsh(mesh, path, GmshVersion::v22);
}

}  // namespace tunica::mesh
