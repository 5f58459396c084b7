#include "tunica/mesh/block.hpp"

#include <algorithm>
#include <cmath>

#include "tunica/base/error.hpp"
#include "tunica/mesh/faces.hpp"
#include "tunica/mesh/formats/number_tags.hpp"
#include "tunica/mesh/text.hpp"
#include "tunica/mesh/validate.hpp"

namespace tunica::mesh {

namespace {

constexpr int patch_id = 7;  // behind the six sides

void check(const Block& block) {
  const char* axes[] = {"x", "y", "z"};
  for (int i = 0; i < 3; ++i) {
    TUNICA_CHECK(std::isfinite(block.size[i]) && block.size[i] > 0.0,
                 std::string("block: size along ") + axes[i] + " is " + show(block.size[i]) +
                     ", expected a positive length");
    TUNICA_CHECK(block.cells[i] >= 1 && block.cells[i] <= 10000,
                 std::string("block: cells along ") + axes[i] + " are " +
                     std::to_string(block.cells[i]) + ", expected 1..10000");
  }
  const double tets = 6.0 * block.cells[0] * block.cells[1] * block.cells[2];
  TUNICA_CHECK(tets < 2e8,
               "block: these cells make " + show(tets) + " tetrahedra, expected fewer than 2e8");
  for (int i = 0; i < 2; ++i)
    TUNICA_CHECK(block.patch[i] >= 0 && block.patch[i] <= block.cells[i],
                 std::string("block: the patch has ") + std::to_string(block.patch[i]) +
                     " cells along " + axes[i] + ", expected 0.." + std::to_string(block.cells[i]));
  TUNICA_CHECK((block.patch[0] == 0) == (block.patch[1] == 0),
               "block: the patch has cells along one axis only, expected both or none");
}

class Grid {
public:
  explicit Grid(const Block& block) : block_(block) {
    add_vertices();
    std::array<int, 3> path{0, 1, 2};
    do add_tets_along(path);
    while (std::next_permutation(path.begin(), path.end()));
    mesh_.tet_region.assign(mesh_.tets.size(), 0);
    mesh_.regions = {{1, "block"}};
    add_surfaces();
  }

  Mesh take() { return std::move(mesh_); }

private:
  int vertex(const std::array<int, 3>& at) const {
    return (at[2] * (block_.cells[1] + 1) + at[1]) * (block_.cells[0] + 1) + at[0];
  }
  std::array<int, 3> place(int v) const {
    const int nx = block_.cells[0] + 1, ny = block_.cells[1] + 1;
    return {v % nx, v / nx % ny, v / nx / ny};
  }

  void add_vertices() {
    const int count = vertex(block_.cells) + 1;
    for (int v = 0; v < count; ++v) {
      const std::array<int, 3> at = place(v);
      Vec3 x;
      for (int i = 0; i < 3; ++i) x[i] = block_.size[i] * at[i] / block_.cells[i];
      mesh_.vertices.push_back(x);
    }
  }

  /// One tetrahedron in each cell: from corner to corner along the axes in this order.
  void add_tets_along(const std::array<int, 3>& path) {
    for (int k = 0; k < block_.cells[2]; ++k)
      for (int j = 0; j < block_.cells[1]; ++j)
        for (int i = 0; i < block_.cells[0]; ++i) {
          std::array<int, 3> at{i, j, k};
          std::array<int, 4> tet{vertex(at), 0, 0, 0};
          for (int s = 0; s < 3; ++s) {
            ++at[path[s]];
            tet[s + 1] = vertex(at);
          }
          mesh_.tets.push_back(tet);
          if (volume(mesh_, static_cast<int>(mesh_.tets.size()) - 1) < 0.0)
            std::swap(mesh_.tets.back()[2], mesh_.tets.back()[3]);
        }
  }

  /// True where the vertices all lie between these places along the axis.
  bool lies(const std::array<int, 3>& triangle, int axis, int lowest, int highest) const {
    return std::all_of(triangle.begin(), triangle.end(), [&](int v) {
      return lowest <= place(v)[axis] && place(v)[axis] <= highest;
    });
  }

  int surface_of(const std::array<int, 3>& triangle) const {
    const auto& cells = block_.cells;
    if (lies(triangle, 2, cells[2], cells[2]) && lies(triangle, 0, 0, block_.patch[0]) &&
        lies(triangle, 1, 0, block_.patch[1]))
      return patch_id;
    int side = 0;
    while (!lies(triangle, side / 2, side % 2 == 0 ? 0 : cells[side / 2],
                 side % 2 == 0 ? 0 : cells[side / 2]))
      ++side;
    return side + 1;
  }

  void add_surfaces() {
    for (const Face& face : faces(mesh_)) {
      if (!face.is_boundary()) continue;
      mesh_.triangles.push_back(face.vertices);
      mesh_.triangle_surface.push_back(surface_of(face.vertices));
    }
    // Without a patch, or without anything beside it, one of the names is not used.
    mesh_.surfaces = number_tags({{1, "x_low"},
                                  {2, "x_high"},
                                  {3, "y_low"},
                                  {4, "y_high"},
                                  {5, "z_low"},
                                  {6, "z_high"},
                                  {patch_id, "patch"}},
                                 "surface", mesh_.triangle_surface);
  }

  Block block_;
  Mesh mesh_;
};

}  // namespace

Mesh make_block(const Block& block) {
  check(block);
  Mesh mesh = Grid(block).take();
  validate(mesh, "block");
  return mesh;
}

}  // namespace tunica::mesh
