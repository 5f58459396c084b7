#include "tunica/mesh/tube.hpp"

#include <algorithm>
#include <cmath>

#include "tunica/base/error.hpp"
#include "tunica/mesh/disc.hpp"
#include "tunica/mesh/faces.hpp"
#include "tunica/mesh/formats/number_tags.hpp"
#include "tunica/mesh/text.hpp"
#include "tunica/mesh/validate.hpp"

namespace tunica::mesh {
namespace {

void check_length(double value, const std::string& name) {
  TUNICA_CHECK(std::isfinite(value) && value > 0.0,
               "tube: " + name + " is " + show(value) + ", expected a positive length");
}

void check_count(int value, int low, const std::string& name) {
  TUNICA_CHECK(value >= low && value <= 100000, "tube: " + name + " is " + std::to_string(value) +
                                                    ", expected " + std::to_string(low) +
                                                    "..100000");
}

void check_grading(double value, const std::string& name) {
  TUNICA_CHECK(value >= 0.01 && value <= 100.0,
               "tube: " + name + " is " + show(value) + ", expected 0.01..100");
}

void check_size(const Tube& t) {
  const double cells =
      (t.with_lumen ? t.around * (t.around / 16.0 + t.rings) : 0.0) +
      (t.with_wall ? 1.0 * t.around * (t.media_layers + t.adventitia_layers) : 0.0);
  TUNICA_CHECK(6.0 * cells * t.axial < 2e8, "tube: these divisions make " +
                                                show(6.0 * cells * t.axial) +
                                                " tetrahedra, expected fewer than 2e8");
}

void check(const Tube& t) {
  check_length(t.radius, "radius");
  check_length(t.length, "length");
  check_count(t.around, 4, "around");
  TUNICA_CHECK(t.around % 4 == 0, "tube: around is " + std::to_string(t.around) +
                                      ", expected a multiple of 4 (the core is a square grid)");
  check_count(t.axial, 1, "axial");
  TUNICA_CHECK(t.with_lumen || t.with_wall,
               "tube: neither lumen nor wall, expected at least one of them");
  check_count(t.rings, 0, "rings");
  check_grading(t.ring_grading, "ring grading");
  check_grading(t.axial_grading, "axial grading");
  check_count(t.media_layers, 0, "media layers");
  check_count(t.adventitia_layers, 0, "adventitia layers");
  if (t.with_wall) {
    TUNICA_CHECK(t.media_layers + t.adventitia_layers > 0,
                 "tube: media and adventitia have no layers, expected at least one. Switch the "
                 "wall off to have the lumen only.");
    if (t.media_layers > 0) check_length(t.media, "media thickness");
    if (t.adventitia_layers > 0) check_length(t.adventitia, "adventitia thickness");
  }
  check_size(t);
}

/// Pulls the disc along z. Vertex v of level k is k * (vertices of the disc) + v.
class Extrusion {
public:
  explicit Extrusion(const Tube& tube) : disc_(make_disc(tube)) {
    const std::vector<double> z = graded(tube.axial, tube.axial_grading);
    for (const double level : z)
      for (const auto& v : disc_.vertices)
        mesh_.vertices.push_back({v.x, v.y, tube.length * level});
    for (int slice = 0; slice < tube.axial; ++slice) {
      for (const auto& triangle : disc_.triangles) add_prism(triangle, slice);
      for (const auto& edge : disc_.edges) add_strip(edge, slice);
    }
    for (const auto& t : disc_.triangles) {
      const bool is_fluid = t.region == fluid_id;
      const auto& v = t.vertices;
      add_triangle({v[0], v[2], v[1]}, is_fluid ? inlet_id : struct_in_id);
      add_triangle({at(v[0], tube.axial), at(v[1], tube.axial), at(v[2], tube.axial)},
                   is_fluid ? outlet_id : struct_out_id);
    }
    name_tags();
  }

  Mesh take() { return std::move(mesh_); }

private:
  int at(int v, int level) const { return level * static_cast<int>(disc_.vertices.size()) + v; }

  /// A total order of the disc's vertices, reversed from slice to slice: the diagonals of the
  /// sides zigzag, so that the mesh has no preferred direction of rotation.
  bool comes_before(int a, int b, int slice) const {
    const bool is_odd_a = disc_.vertices[a].is_odd, is_odd_b = disc_.vertices[b].is_odd;
    const bool is_before = is_odd_a != is_odd_b ? is_odd_b : a < b;
    return is_before == (slice % 2 == 0);
  }

  /// Side diagonals rise from the earlier vertex to the later one.
  void add_prism(const Disc::Triangle& triangle, int slice) {
    std::array<int, 3> v = triangle.vertices;
    std::sort(v.begin(), v.end(), [&](int a, int b) { return comes_before(a, b, slice); });
    const int p = at(v[0], slice), q = at(v[1], slice), r = at(v[2], slice);
    const int P = at(v[0], slice + 1), Q = at(v[1], slice + 1), R = at(v[2], slice + 1);
    add_tet({p, q, r, R}, triangle.region);
    add_tet({p, q, Q, R}, triangle.region);
    add_tet({p, P, Q, R}, triangle.region);
  }

  void add_tet(const std::array<int, 4>& tet, int region) {
    mesh_.tets.push_back(tet);
    mesh_.tet_region.push_back(region);  // the number; name_tags() turns it into the position
    if (volume(mesh_, static_cast<int>(mesh_.tets.size()) - 1) < 0.0)
      std::swap(mesh_.tets.back()[2], mesh_.tets.back()[3]);
  }

  /// Normals away from the axis.
  void add_strip(const Disc::Edge& edge, int slice) {
    const int a = edge.vertices[0], b = edge.vertices[1];
    const int a0 = at(a, slice), b0 = at(b, slice), a1 = at(a, slice + 1), b1 = at(b, slice + 1);
    if (comes_before(a, b, slice)) {
      add_triangle({a0, b0, b1}, edge.surface);
      add_triangle({a0, b1, a1}, edge.surface);
    } else {
      add_triangle({a0, b0, a1}, edge.surface);
      add_triangle({b0, b1, a1}, edge.surface);
    }
  }

  void add_triangle(const std::array<int, 3>& triangle, int surface) {
    mesh_.triangles.push_back(triangle);
    mesh_.triangle_surface.push_back(surface);
  }

  void name_tags() {
    mesh_.regions =
        number_tags({{fluid_id, "fluid"}, {media_id, "media"}, {adventitia_id, "adventitia"}},
                    "region", mesh_.tet_region);
    mesh_.surfaces = number_tags({{inlet_id, "inlet"},
                                  {outlet_id, "outlet"},
                                  {interface_id, "interface"},
                                  {struct_in_id, "struct_in"},
                                  {struct_out_id, "struct_out"},
                                  {outer_id, "outer"},
                                  {layer_id, "layer"}},
                                 "surface", mesh_.triangle_surface);
  }

  Disc disc_;
  Mesh mesh_;
};

}  // namespace

Mesh make_tube(const Tube& tube) {
  check(tube);
  Mesh mesh = Extrusion(tube).take();
  validate(mesh, "tube");
  return mesh;
}

}  // namespace tunica::mesh
