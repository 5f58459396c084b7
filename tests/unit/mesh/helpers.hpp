#pragma once
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <ostream>
#include <set>
#include <string>
#include <vector>

#include "tunica/base/error.hpp"
#include "tunica/mesh/mesh.hpp"
#include "tunica/mesh/tube.hpp"

namespace tunica::mesh {

const std::string data_folder = TUNICA_TEST_DATA;
const double pi = std::acos(-1.0);

inline std::set<std::string> names(const std::vector<Tag>& tags) {
  std::set<std::string> result;
  for (const Tag& tag : tags) result.insert(tag.name);
  return result;
}

/// A name in the system's folder for temporary files; the file is removed at the end.
class TemporaryFile {
public:
  explicit TemporaryFile(const std::string& name)
      : path((std::filesystem::temp_directory_path() /
              ("tunica-" + std::to_string(::getpid()) + "-" + name))
                 .string()) {}
  ~TemporaryFile() { std::filesystem::remove(path); }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  void fill(const std::string& content) const { std::ofstream(path, std::ios::binary) << content; }

  const std::string path;
};

/// The whole content of a file.
inline std::string read_text(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

/// True if the action throws tunica::Error whose text holds the part.
template <typename Action>
bool fails_with(const std::string& part, std::ostream& out, Action action) {
  try {
    action();
  } catch (const Error& error) {
    const bool is_found = std::string(error.what()).find(part) != std::string::npos;
    if (!is_found) out << "\nexpected \"" << part << "\" in: " << error.what() << "\n";
    return is_found;
  }
  out << "\nno error, expected \"" << part << "\"\n";
  return false;
}

/// The smallest tube of three regions: 42 tetrahedra, or a little more.
inline Tube smallest_tube() {
  Tube tube;
  tube.around = 4;
  tube.axial = 1;
  tube.length = 1.0;
  tube.media_layers = 1;
  return tube;
}

inline Vec3 centroid(const Mesh& mesh, std::size_t t) {
  Vec3 sum{};
  for (const int v : mesh.tets[t]) sum += 0.25 * mesh.vertices[v];
  return sum;
}

/// The mesh with two sets of vectors on its tetrahedra, the first their centroids.
inline Mesh with_vectors(Mesh mesh) {
  mesh.tet_vectors = {{"centre", {}}, {"number", {}}};
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    mesh.tet_vectors[0].values.push_back(centroid(mesh, t));
    mesh.tet_vectors[1].values.push_back({double(t), 0.5, -1.0 / 3.0});
  }
  return mesh;
}

/// The same vertices bit by bit, elements, tags, names and vectors; numbers of tags may differ.
inline bool are_equal(const Mesh& a, const Mesh& b) {
  const auto same_names = [](const std::vector<Tag>& x, const std::vector<Tag>& y) {
    return std::equal(x.begin(), x.end(), y.begin(), y.end(),
                      [](const Tag& s, const Tag& t) { return s.name == t.name; });
  };
  const bool same_vectors =
      std::equal(a.tet_vectors.begin(), a.tet_vectors.end(), b.tet_vectors.begin(),
                 b.tet_vectors.end(), [](const TetVectors& x, const TetVectors& y) {
                   return x.name == y.name && x.values == y.values;
                 });
  return same_vectors && a.vertices == b.vertices && a.tets == b.tets &&
         a.tet_region == b.tet_region && a.triangles == b.triangles &&
         a.triangle_surface == b.triangle_surface && same_names(a.regions, b.regions) &&
         same_names(a.surfaces, b.surfaces);
}

/// are_equal, and the tags' numbers too.
inline bool are_identical(const Mesh& a, const Mesh& b) {
  const auto same_ids = [](const std::vector<Tag>& x, const std::vector<Tag>& y) {
    return std::equal(x.begin(), x.end(), y.begin(), y.end(),
                      [](const Tag& s, const Tag& t) { return s.id == t.id; });
  };
  return are_equal(a, b) && same_ids(a.regions, b.regions) && same_ids(a.surfaces, b.surfaces);
}

}  // namespace tunica::mesh
