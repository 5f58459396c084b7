#pragma once
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <ostream>
#include <string>

#include "base/error.hpp"
#include "mesh/mesh.hpp"
#include "mesh/tube.hpp"

namespace tunica::mesh {

const std::string data_folder = TUNICA_TEST_DATA;

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

/// The same vertices bit by bit, elements, tags and names; numbers of tags may differ.
inline bool are_equal(const Mesh& a, const Mesh& b) {
  const auto same_names = [](const std::vector<Tag>& x, const std::vector<Tag>& y) {
    return std::equal(x.begin(), x.end(), y.begin(), y.end(),
                      [](const Tag& s, const Tag& t) { return s.name == t.name; });
  };
  return a.vertices == b.vertices && a.tets == b.tets && a.tet_region == b.tet_region &&
         a.triangles == b.triangles && a.triangle_surface == b.triangle_surface &&
         same_names(a.regions, b.regions) && same_names(a.surfaces, b.surfaces);
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
