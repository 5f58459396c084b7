#include "tunica/base/error.hpp"
#include "tunica/io/atomic_file.hpp"
#include "tunica/mesh/formats/gmsh.hpp"
#include "tunica/mesh/text.hpp"

namespace tunica::mesh {
namespace {

std::string point(const Vec3& x) { return exact(x[0]) + " " + exact(x[1]) + " " + exact(x[2]); }

template <std::size_t N>
std::string corners(const std::array<int, N>& element) {
  std::string text;
  for (const int v : element) text += " " + std::to_string(v + 1);
  return text + "\n";
}

/// Physical names of the tags; the number 0 means "no physical group" and has none.
std::string names(const Mesh& mesh, const std::string& path) {
  int n = 0;
  std::string lines;
  const auto add = [&](const std::vector<Tag>& tags, const std::string& dimension) {
    for (const Tag& tag : tags) {
      TUNICA_CHECK(tag.name.find_first_of("\"\n") == tag.name.npos,
                   path + ": the name " + tag.name +
                       " holds a quotation mark or a line break, "
                       "which Gmsh files cannot");
      if (tag.id == 0) continue;
      lines += dimension + " " + std::to_string(tag.id) + " \"" + tag.name + "\"\n";
      ++n;
    }
  };
  add(mesh.regions, "3");
  add(mesh.surfaces, "2");
  return "$PhysicalNames\n" + std::to_string(n) + "\n" + lines + "$EndPhysicalNames\n";
}

std::string nodes_22(const Mesh& mesh) {
  std::string text = "$Nodes\n" + std::to_string(mesh.vertices.size()) + "\n";
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v)
    text += std::to_string(v + 1) + " " + point(mesh.vertices[v]) + "\n";
  return text + "$EndNodes\n";
}

std::string elements_22(const Mesh& mesh) {
  std::size_t next = 1;
  std::string text =
      "$Elements\n" + std::to_string(mesh.triangles.size() + mesh.tets.size()) + "\n";
  const auto begin = [&](int type, int id) {
    text += std::to_string(next++) + " " + std::to_string(type) + " 2 " + std::to_string(id) + " " +
            std::to_string(id);
  };
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    begin(2, mesh.surfaces[mesh.triangle_surface[i]].id);
    text += corners(mesh.triangles[i]);
  }
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    begin(4, mesh.regions[mesh.tet_region[t]].id);
    text += corners(mesh.tets[t]);
  }
  return text + "$EndElements\n";
}

/// The vectors on the tetrahedra. number_of: of each tetrahedron in the file.
std::string element_data(const Mesh& mesh, const std::vector<std::size_t>& number_of) {
  std::string text;
  for (const TetVectors& vectors : mesh.tet_vectors) {
    text += "$ElementData\n1\n\"" + vectors.name + "\"\n1\n0\n3\n0\n3\n" +
            std::to_string(vectors.values.size()) + "\n";
    for (std::size_t t = 0; t < vectors.values.size(); ++t)
      text += std::to_string(number_of[t]) + " " + point(vectors.values[t]) + "\n";
    text += "$EndElementData\n";
  }
  return text;
}

/// Numbers of the tetrahedra behind the triangles, as they stand or region by region.
std::vector<std::size_t> tet_numbers(const Mesh& mesh, GmshVersion version) {
  std::size_t next = mesh.triangles.size() + 1;
  std::vector<std::size_t> number_of(mesh.tets.size());
  const std::size_t passes = version == GmshVersion::v22 ? 1 : mesh.regions.size();
  for (std::size_t r = 0; r < passes; ++r)
    for (std::size_t t = 0; t < mesh.tets.size(); ++t)
      if (version == GmshVersion::v22 || mesh.tet_region[t] == static_cast<int>(r))
        number_of[t] = next++;
  return number_of;
}

/// One entity per tag, with its own number; the bounding boxes play no role for readers.
std::string entities_41(const Mesh& mesh) {
  std::string text = "$Entities\n0 0 " + std::to_string(mesh.surfaces.size()) + " " +
                     std::to_string(mesh.regions.size()) + "\n";
  for (const auto* tags : {&mesh.surfaces, &mesh.regions})
    for (const Tag& tag : *tags) {
      const std::string group = tag.id == 0 ? "0" : "1 " + std::to_string(tag.id);
      text += std::to_string(tag.id) + " 0 0 0 0 0 0 " + group + " 0\n";
    }
  return text + "$EndEntities\n";
}

std::string nodes_41(const Mesh& mesh) {
  const std::string n = std::to_string(mesh.vertices.size());
  std::string text =
      "$Nodes\n1 " + n + " 1 " + n + "\n3 " + std::to_string(mesh.regions[0].id) + " 0 " + n + "\n";
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) text += std::to_string(v + 1) + "\n";
  for (const Vec3& x : mesh.vertices) text += point(x) + "\n";
  return text + "$EndNodes\n";
}

/// The blocks of one dimension. next: number of the next element.
template <std::size_t N>
std::string blocks_41(const std::vector<std::array<int, N>>& elements, const std::vector<int>& tag,
                      const std::vector<Tag>& tags, std::size_t& next) {
  std::string text;
  for (std::size_t s = 0; s < tags.size(); ++s) {
    std::string block;
    std::size_t n = 0;
    for (std::size_t e = 0; e < elements.size(); ++e) {
      if (tag[e] != static_cast<int>(s)) continue;
      block += std::to_string(next++) + corners(elements[e]);
      ++n;
    }
    text += std::to_string(N - 1) + " " + std::to_string(tags[s].id) + (N == 4 ? " 4 " : " 2 ") +
            std::to_string(n) + "\n" + block;
  }
  return text;
}

std::string elements_41(const Mesh& mesh) {
  const std::string n = std::to_string(mesh.triangles.size() + mesh.tets.size());
  std::size_t next = 1;
  std::string text = "$Elements\n" + std::to_string(mesh.surfaces.size() + mesh.regions.size()) +
                     " " + n + " 1 " + n + "\n";
  text += blocks_41(mesh.triangles, mesh.triangle_surface, mesh.surfaces, next);
  text += blocks_41(mesh.tets, mesh.tet_region, mesh.regions, next);
  return text + "$EndElements\n";
}

}  // namespace

void write_gmsh(const Mesh& mesh, const std::string& path, GmshVersion version) {
  if (version == GmshVersion::v22) {
    io::write_file(path, "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n" + names(mesh, path) +
                             nodes_22(mesh) + elements_22(mesh) +
                             element_data(mesh, tet_numbers(mesh, version)));
  } else {
    io::write_file(path, "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n" + names(mesh, path) +
                             entities_41(mesh) + nodes_41(mesh) + elements_41(mesh) +
                             element_data(mesh, tet_numbers(mesh, version)));
  }
}

}  // namespace tunica::mesh
