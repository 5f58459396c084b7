#include "tunica/mesh/disc.hpp"

#include <cmath>

namespace tunica::mesh {
namespace {

const double pi = std::acos(-1.0);
/// Half-width of the square's side, in parts of the radius, if rings surround it.
constexpr double core_size = 0.55;
/// How far the sides of that square bulge towards a circle: 0 straight, 1 round.
constexpr double core_bulge = 0.5;

class DiscBuilder {
public:
  explicit DiscBuilder(const Tube& tube) : tube_(tube), side_(tube.around / 4) {}

  Disc build() {
    std::vector<int> ring;
    if (tube_.with_lumen) {
      ring = add_core();
      ring = add_lumen_rings(ring);
    } else {
      ring = add_circle(tube_.radius, tube_.rings);
    }
    add_edges(ring, interface_id);
    if (tube_.with_wall) add_wall(ring);
    return std::move(disc_);
  }

private:
  int add_vertex(double x, double y, bool is_odd) {
    disc_.vertices.push_back({x, y, is_odd});
    return static_cast<int>(disc_.vertices.size()) - 1;
  }

  /// Diagonal by the shorter one; of equal ones (a matter of round-off) the one between even
  /// vertices, which makes the pattern symmetric.
  void add_quad(const std::array<int, 4>& v, int region) {
    const auto length = [&](int a, int b) {
      const auto &p = disc_.vertices[v[a]], &q = disc_.vertices[v[b]];
      return std::hypot(p.x - q.x, p.y - q.y);
    };
    const double d02 = length(0, 2), d13 = length(1, 3);
    const bool is_tie = std::abs(d02 - d13) < 1e-6 * d02;
    if (is_tie ? !disc_.vertices[v[0]].is_odd : d02 < d13) {
      disc_.triangles.push_back({{v[0], v[1], v[2]}, region});
      disc_.triangles.push_back({{v[0], v[2], v[3]}, region});
    } else {
      disc_.triangles.push_back({{v[0], v[1], v[3]}, region});
      disc_.triangles.push_back({{v[1], v[2], v[3]}, region});
    }
  }

  /// Point (x, y) of the square [-1, 1]² on the disc of the radius: concentric squares become
  /// circles, bulging more and more towards the outside.
  Disc::Vertex bend(double x, double y) const {
    const double s = std::max(std::abs(x), std::abs(y));
    if (s == 0.0) return {0.0, 0.0, false};
    const double angle =
        std::abs(x) >= std::abs(y) ? pi / 4.0 * y / x : pi / 2.0 - pi / 4.0 * x / y;
    const double turn = (std::abs(x) >= std::abs(y) ? x < 0.0 : y < 0.0) ? pi : 0.0;
    const double bulge = tube_.rings > 0 ? core_bulge : s;
    const double size = (tube_.rings > 0 ? core_size : 1.0) * tube_.radius;
    const double flat = size * (1.0 - bulge) * std::sqrt(0.5), round = size * bulge * s;
    return {flat * x + round * std::cos(angle + turn), flat * y + round * std::sin(angle + turn),
            false};
  }

  /// The square grid; returns its border, counter-clockwise from its corner at -135°.
  std::vector<int> add_core() {
    const int n = side_;
    const auto index = [&](int i, int j) { return j * (n + 1) + i; };
    for (int j = 0; j <= n; ++j)
      for (int i = 0; i <= n; ++i) {
        const Disc::Vertex v = bend(2.0 * i / n - 1.0, 2.0 * j / n - 1.0);
        add_vertex(v.x, v.y, (i + j) % 2 == 1);
      }
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i)
        add_quad({index(i, j), index(i + 1, j), index(i + 1, j + 1), index(i, j + 1)}, fluid_id);
    std::vector<int> border;
    for (int k = 0; k < n; ++k) border.push_back(index(k, 0));
    for (int k = 0; k < n; ++k) border.push_back(index(n, k));
    for (int k = 0; k < n; ++k) border.push_back(index(n - k, n));
    for (int k = 0; k < n; ++k) border.push_back(index(0, n - k));
    return border;
  }

  std::vector<int> add_circle(double radius, int number) {
    std::vector<int> ring;
    for (int k = 0; k < tube_.around; ++k) {
      const double angle = 2.0 * pi * k / tube_.around - 0.75 * pi;
      ring.push_back(
          add_vertex(radius * std::cos(angle), radius * std::sin(angle), (k + number) % 2 == 1));
    }
    return ring;
  }

  void add_quads(const std::vector<int>& inner, const std::vector<int>& outer, int region) {
    for (int k = 0; k < tube_.around; ++k) {
      const int next = (k + 1) % tube_.around;
      add_quad({inner[k], outer[k], outer[next], inner[next]}, region);
    }
  }

  std::vector<int> add_lumen_rings(const std::vector<int>& core) {
    std::vector<int> inner = core;
    const std::vector<double> position = graded(tube_.rings, tube_.ring_grading);
    for (int ring = 1; ring <= tube_.rings; ++ring) {
      const std::vector<int> outer = add_circle(tube_.radius, ring);
      for (int k = 0; k < tube_.around; ++k) {  // between the core's border and the circle
        const auto from = disc_.vertices[core[k]];
        auto& to = disc_.vertices[outer[k]];
        to.x = from.x + position[ring] * (to.x - from.x);
        to.y = from.y + position[ring] * (to.y - from.y);
      }
      add_quads(inner, outer, fluid_id);
      inner = outer;
    }
    return inner;
  }

  void add_wall(std::vector<int> inner) {
    int number = tube_.rings;
    double radius = tube_.radius;
    const auto add_layers = [&](int layers, double thickness, int region) {
      for (int layer = 1; layer <= layers; ++layer) {
        const std::vector<int> outer =
            add_circle(radius + thickness * layer / layers, number + layer);
        add_quads(inner, outer, region);
        inner = outer;
      }
      number += layers;
      if (layers > 0) radius += thickness;
    };
    add_layers(tube_.media_layers, tube_.media, media_id);
    const bool has_both = tube_.media_layers > 0 && tube_.adventitia_layers > 0;
    if (has_both && tube_.with_layer_surface) add_edges(inner, layer_id);
    add_layers(tube_.adventitia_layers, tube_.adventitia, adventitia_id);
    add_edges(inner, outer_id);
  }

  void add_edges(const std::vector<int>& ring, int surface) {
    for (int k = 0; k < tube_.around; ++k)
      disc_.edges.push_back({{ring[k], ring[(k + 1) % tube_.around]}, surface});
  }

  const Tube& tube_;
  int side_;
  Disc disc_;
};

}  // namespace

std::vector<double> graded(int n, double grading) {
  const double ratio = n > 1 ? std::pow(grading, 1.0 / (n - 1)) : 1.0;
  std::vector<double> position{0.0};
  double size = 1.0;
  for (int i = 0; i < n; ++i, size *= ratio) position.push_back(position.back() + size);
  for (double& x : position) x /= position.back();
  return position;
}

Disc make_disc(const Tube& tube) { return DiscBuilder(tube).build(); }

}  // namespace tunica::mesh
