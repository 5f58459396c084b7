#include "tunica/mesh/refine.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "tunica/base/error.hpp"
#include "tunica/mesh/faces.hpp"
#include "tunica/mesh/text.hpp"
#include "tunica/mesh/validate.hpp"

namespace tunica::mesh {
namespace {

/// Edges count as equally long within this part.
constexpr double tie = 1e-9;
constexpr double most_radius_spread = 1e-3;

class Refinement {
public:
  explicit Refinement(const Mesh& mesh) : old_(mesh) {
    number_edges();
    add_vertices();
    for (std::size_t t = 0; t < old_.tets.size(); ++t) split_tet(static_cast<int>(t));
    for (std::size_t i = 0; i < old_.triangles.size(); ++i) split_triangle(static_cast<int>(i));
    new_.regions = old_.regions;
    new_.surfaces = old_.surfaces;
    inherit_vectors();
  }

  void project(const std::string& surface) {
    const int index = surface_index(old_, surface);
    const double radius = cylinder_radius(index);
    for (std::size_t i = 0; i < old_.triangles.size(); ++i) {
      if (old_.triangle_surface[i] != index) continue;
      const auto& v = old_.triangles[i];
      for (int e = 0; e < 3; ++e) {
        Vec3& x = new_.vertices[middle(v[e], v[(e + 1) % 3])];
        const double scale = radius / std::hypot(x[0], x[1]);
        x[0] *= scale;
        x[1] *= scale;
      }
    }
  }

  void check_volumes(const std::vector<std::string>& projected) const {
    int inverted = 0, first = -1;
    for (int t = 0; t < static_cast<int>(new_.tets.size()); ++t)
      if (volume(new_, t) <= 0.0 && inverted++ == 0) first = t;
    if (inverted == 0) return;
    std::string names;
    for (const std::string& name : projected)
      names += (names.empty() ? "\"" : ", \"") + name + "\"";
    throw Error("refinement: the projection of " + names + " inverts " + std::to_string(inverted) +
                " elements, the first at " + show(corners(new_, first)[0]) + " in region \"" +
                new_.regions[new_.tet_region[first]].name +
                "\". Refine without projection, or project all surfaces of the thin layers.");
  }

  Mesh take() { return std::move(new_); }

private:
  static std::uint64_t key(int a, int b) {
    return static_cast<std::uint64_t>(std::min(a, b)) << 32 |
           static_cast<std::uint64_t>(std::max(a, b));
  }

  void number_edges() {
    edges_.reserve(6 * old_.tets.size());
    for (const auto& tet : old_.tets)
      for (const auto& e : tet_edges) edges_.push_back(key(tet[e[0]], tet[e[1]]));
    std::sort(edges_.begin(), edges_.end());
    edges_.erase(std::unique(edges_.begin(), edges_.end()), edges_.end());
    TUNICA_CHECK(edges_.size() + old_.vertices.size() < std::numeric_limits<int>::max() / 4 &&
                     8 * old_.tets.size() < std::numeric_limits<int>::max() / 4,
                 "refinement: the result would have " + std::to_string(8 * old_.tets.size()) +
                     " tetrahedra, more than can be numbered");
  }

  void add_vertices() {
    new_.vertices = old_.vertices;
    new_.vertices.reserve(old_.vertices.size() + edges_.size());
    for (const std::uint64_t edge : edges_)
      new_.vertices.push_back(0.5 *
                              (old_.vertices[edge >> 32] + old_.vertices[edge & 0xffffffffu]));
  }

  int middle(int a, int b) const {
    const auto found = std::lower_bound(edges_.begin(), edges_.end(), key(a, b));
    return static_cast<int>(old_.vertices.size() + (found - edges_.begin()));
  }

  double length(int a, int b) const { return norm(new_.vertices[b] - new_.vertices[a]); }

  void split_tet(int t) {
    const auto& v = old_.tets[t];
    const int region = old_.tet_region[t];
    std::array<int, 6> m;
    for (int e = 0; e < 6; ++e) m[e] = middle(v[tet_edges[e][0]], v[tet_edges[e][1]]);
    add({v[0], m[0], m[1], m[2]}, region);
    add({v[1], m[0], m[3], m[4]}, region);
    add({v[2], m[1], m[3], m[5]}, region);
    add({v[3], m[2], m[4], m[5]}, region);
    // Middles of opposite edges are opposite corners of the octahedron.
    int d = 0;
    for (int other = 1; other < 3; ++other)
      if (length(m[other], m[5 - other]) < (1.0 - tie) * length(m[d], m[5 - d])) d = other;
    const int a = (d + 1) % 3, b = (d + 2) % 3;
    const std::array<int, 4> belt{m[a], m[b], m[5 - a], m[5 - b]};
    for (int i = 0; i < 4; ++i) add({m[d], m[5 - d], belt[i], belt[(i + 1) % 4]}, region);
  }

  void inherit_vectors() {
    for (const TetVectors& old : old_.tet_vectors) {
      TetVectors& vectors = new_.tet_vectors.emplace_back(TetVectors{old.name, {}});
      for (const Vec3& v : old.values) vectors.values.insert(vectors.values.end(), 8, v);
    }
  }

  void add(std::array<int, 4> tet, int region) {
    const auto& x = new_.vertices;
    if (signed_volume(x[tet[0]], x[tet[1]], x[tet[2]], x[tet[3]]) < 0.0) std::swap(tet[2], tet[3]);
    new_.tets.push_back(tet);
    new_.tet_region.push_back(region);
  }

  void split_triangle(int i) {
    const auto& v = old_.triangles[i];
    const int m01 = middle(v[0], v[1]), m12 = middle(v[1], v[2]), m20 = middle(v[2], v[0]);
    const std::array<std::array<int, 3>, 4> parts{
        {{v[0], m01, m20}, {m01, v[1], m12}, {m20, m12, v[2]}, {m01, m12, m20}}};
    for (const auto& part : parts) {
      new_.triangles.push_back(part);
      new_.triangle_surface.push_back(old_.triangle_surface[i]);
    }
  }

  double cylinder_radius(int surface) const {
    double low = std::numeric_limits<double>::max(), high = 0.0;
    for (std::size_t i = 0; i < old_.triangles.size(); ++i) {
      if (old_.triangle_surface[i] != surface) continue;
      for (const int v : old_.triangles[i]) {
        const double radius = std::hypot(old_.vertices[v][0], old_.vertices[v][1]);
        low = std::min(low, radius);
        high = std::max(high, radius);
      }
    }
    TUNICA_CHECK(high - low <= most_radius_spread * high && high > 0.0,
                 "refinement: surface \"" + old_.surfaces[surface].name +
                     "\" is no cylinder about the z axis: its radii range from " + show(low) +
                     " to " + show(high) + ". Do not project it.");
    return 0.5 * (low + high);
  }

  const Mesh& old_;
  Mesh new_;
  std::vector<std::uint64_t> edges_;  ///< lower end · 2³² + upper end, ascending
};

}  // namespace

Mesh refine(const Mesh& mesh, const std::vector<std::string>& project) {
  Refinement refinement(mesh);
  for (const std::string& surface : project) refinement.project(surface);
  refinement.check_volumes(project);
  return refinement.take();
}

}  // namespace tunica::mesh
