#include "tunica/mesh/read.hpp"

#include <Teuchos_DefaultSerialComm.hpp>
#include <filesystem>
#include <fstream>

#include "tunica/base/error.hpp"
#include "tunica/mesh/distributed/text_mesh.hpp"
#include "tunica/mesh/formats/gmsh.hpp"
#include "tunica/mesh/formats/hdf5.hpp"
#include "tunica/mesh/formats/netgen.hpp"
#include "tunica/mesh/validate.hpp"

namespace tunica::mesh {
namespace {

bool starts_with(const std::string& text, const std::string& start) {
  return text.compare(0, start.size(), start) == 0;
}

/// The first line that is neither empty nor a comment, at most 64 characters of it, behind a
/// byte-order mark.
std::string first_line(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  std::string head(4096, '\0');
  in.read(head.data(), static_cast<std::streamsize>(head.size()));
  head.resize(static_cast<std::size_t>(in.gcount()));
  std::size_t at = starts_with(head, "\xef\xbb\xbf") ? 3 : 0;
  while (at < head.size()) {
    const std::size_t end = std::min(head.find_first_of("\r\n", at), head.size());
    const std::size_t start = std::min(head.find_first_not_of(" \t", at), end);
    if (start < end && head[start] != '#') return head.substr(start, std::min(end - start, 64ul));
    at = end + 1;
  }
  return "";
}

}  // namespace

bool is_hdf5(const std::string& path) {
  return starts_with(first_line(path), "\x89HDF") ||
         std::filesystem::path(path).extension() == ".h5";
}

std::function<void(RowStream&)> text_reader(const std::string& path) {
  const std::string head = first_line(path);
  const auto extension = std::filesystem::path(path).extension();
  TUNICA_CHECK(!starts_with(head, "("),
               path +
                   ": a mesh of Fluent (ANSYS), which is not read. Export it from there for Abaqus "
                   "or Nastran, or open it in ParaView and save it as VTU, for tunica-import.");
  if (starts_with(head, "$MeshFormat") || extension == ".msh")
    return [path](RowStream& rows) { read_gmsh(path, rows); };
  if (starts_with(head, "mesh3d") || extension == ".vol")
    return [path](RowStream& rows) { read_netgen(path, rows); };
  TUNICA_CHECK(std::ifstream(path), path + ": cannot be opened for reading");
  throw Error(path +
              ": not a known mesh format. Expected Gmsh (.msh, ASCII 2.2 or 4.1), Netgen (.vol) or "
              "tunica's own (.h5). tunica-import converts other formats.");
}

Mesh read(const std::string& path) {
  if (is_hdf5(path)) return read_hdf5(path);
  Slab all = read_text_mesh(path, Teuchos::rcp(new Teuchos::SerialComm<int>));
  validate(all.rows, path);
  return std::move(all.rows);
}

}  // namespace tunica::mesh
