#pragma once
#include <array>
#include <map>
#include <string>
#include <vector>

#include "tunica/mesh/distributed/row_stream.hpp"
#include "tunica/mesh/mesh.hpp"

namespace tunica::mesh {

/// The lines of a file, each with the number of its physical curve, 0 for none, and the curves'
/// names.
struct Curves {
  std::vector<std::array<int, 2>> lines;
  std::vector<int> tags;
  std::map<int, std::string> names;
};

/// Reads Gmsh MSH 2.2 or 4.1, ASCII. Points are skipped, and lines unless there is something to
/// keep them in; elements other than 4-node tetrahedra and 3-node triangles are an Error. Negative
/// physical numbers, by which Gmsh reverses an orientation, count as positive.
void read_gmsh(const std::string& path, RowStream& rows, Curves* kept = nullptr);

enum class GmshVersion { v22, v41 };

/// Writes Gmsh ASCII. In 4.1 each region and each surface becomes one entity.
void write_gmsh(const Mesh& mesh, const std::string& path, GmshVersion version);

}  // namespace tunica::mesh
