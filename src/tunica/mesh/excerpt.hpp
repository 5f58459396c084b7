#pragma once
#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "tunica/mesh/mesh.hpp"

namespace tunica::mesh {

/// The part of a mesh that one rank knows and is responsible for, or the whole mesh. A face is
/// checked on the rank responsible for its lowest vertex. That rank has all tetrahedra around such
/// a vertex. Vertices and tetrahedra are in the order of the whole mesh, so that the lowest is the
/// same everywhere.
struct Excerpt {
  /// Places in the whole, for messages; empty where they are those of the mesh.
  struct Numbers {
    std::vector<int> vertices;
    std::vector<long long> tets, triangles;
  };

  explicit Excerpt(const Mesh& all) : mesh(all) {}
  Excerpt(const Mesh& part, const std::vector<char>& answers_for_vertex, const Numbers& numbers)
      : mesh(part), is_mine_(&answers_for_vertex), numbers_(&numbers) {}

  bool has(int vertex) const { return is_mine_ == nullptr || (*is_mine_)[vertex] != 0; }
  bool has(const std::array<int, 3>& face) const {
    return has(std::min({face[0], face[1], face[2]}));
  }
  std::string vertex(int v) const { return std::to_string(numbers_ ? numbers_->vertices[v] : v); }
  std::string tet(int t) const { return std::to_string(numbers_ ? numbers_->tets[t] : t); }
  std::string triangle(int i) const {
    return std::to_string(numbers_ ? numbers_->triangles[i] : i);
  }

  const Mesh& mesh;

private:
  const std::vector<char>* is_mine_ = nullptr;  ///< none: all
  const Numbers* numbers_ = nullptr;
};

}  // namespace tunica::mesh
