#include "tunica/mesh/distributed/refine.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "tunica/base/agreement.hpp"
#include "tunica/base/error.hpp"
#include "tunica/base/reduce.hpp"
#include "tunica/base/sort_once.hpp"
#include "tunica/mesh/distributed/rows.hpp"
#include "tunica/mesh/faces.hpp"
#include "tunica/mesh/text.hpp"
#include "tunica/mesh/validate.hpp"

namespace tunica::mesh {
namespace {

/// Edges count as equally long within this part.
constexpr double tie = 1e-9;
constexpr double most_radius_spread = 1e-3;

/// Lower end · 2³² + upper end: the order of keys is that of the ends.
using Edge = std::uint64_t;
Edge edge_of(int a, int b) {
  return static_cast<Edge>(std::min(a, b)) << 32 | static_cast<Edge>(std::max(a, b));
}
int lower_end(Edge edge) { return static_cast<int>(edge >> 32); }
int upper_end(Edge edge) { return static_cast<int>(edge & 0xffffffffu); }

struct Middle {
  int number;
  Vec3 x;
};

/// The children of a tetrahedron: places among its 4 corners and, behind them, its 6 middles.
using Children = std::array<std::array<int, 4>, 8>;

Children children_of(const std::array<Vec3, 10>& x) {
  Children children{{{0, 4, 5, 6}, {1, 4, 7, 8}, {2, 5, 7, 9}, {3, 6, 8, 9}}};
  // Middles of opposite edges are opposite corners of the octahedron.
  const auto diagonal = [&x](int d) { return norm(x[9 - d] - x[4 + d]); };
  int d = 0;
  for (int other = 1; other < 3; ++other)
    if (diagonal(other) < (1.0 - tie) * diagonal(d)) d = other;
  const int a = (d + 1) % 3, b = (d + 2) % 3;
  const std::array<int, 4> belt{4 + a, 4 + b, 9 - a, 9 - b};
  for (int i = 0; i < 4; ++i) children[4 + i] = {4 + d, 9 - d, belt[i], belt[(i + 1) % 4]};
  for (auto& c : children)
    if (signed_volume(x[c[0]], x[c[1]], x[c[2]], x[c[3]]) < 0.0) std::swap(c[2], c[3]);
  return children;
}

/// The edges that a rank numbers are those whose lower end is among its rows.
class Refinement {
public:
  explicit Refinement(const Slab& slab)
      : old_(slab), comm_(*slab.comm), used_(vertices_of(slab.rows.tets)),
        used_x_(fetch(comm_, used_, slab.rows.vertices, slab.vertices)) {
    number_edges();
    fetch_middles();
    split_tets();
    split_triangles();
  }

  /// Moves new vertices of a surface outwards.
  void project(const std::string& name) {
    int surface = 0;
    on_all(comm_, [&] { surface = surface_index(old_.rows, name); });
    const double radius = cylinder_radius(surface);
    std::vector<Edge> on_surface;
    for (std::size_t i = 0; i < old_.rows.triangles.size(); ++i) {
      if (old_.rows.triangle_surface[i] != surface) continue;
      const auto& v = old_.rows.triangles[i];
      for (int e = 0; e < 3; ++e) on_surface.push_back(edge_of(v[e], v[(e + 1) % 3]));
    }
    sort_once(on_surface);
    std::vector<Edge> mine = exchange(comm_, on_surface, edges_by_rank(on_surface)).items;
    sort_once(mine);
    for (const Edge edge : mine) {
      Vec3& x = edge_x_[place_of_edge(edge)];
      const double scale = radius / std::hypot(x[0], x[1]);
      x[0] *= scale;
      x[1] *= scale;
    }
  }

  Slab take(const std::vector<std::string>& projected) {
    new_.rows.vertices =
        spread(comm_, old_.rows.vertices, old_.place().first_vertex, new_.vertices);
    const std::vector<Vec3> on_edges = spread(comm_, edge_x_, first_number_, new_.vertices);
    new_.rows.vertices.insert(new_.rows.vertices.end(), on_edges.begin(), on_edges.end());
    if (!projected.empty()) check_volumes(projected);
    return std::move(new_);
  }

private:
  std::vector<int> edges_by_rank(const std::vector<Edge>& edges) const {
    std::vector<int> counts;
    auto from = edges.begin();
    for (int r = 0; r < comm_.getSize(); ++r) {
      const auto first = static_cast<Edge>(first_row(old_.vertices, r + 1, comm_.getSize())) << 32;
      const auto to = std::lower_bound(from, edges.end(), first);
      counts.push_back(static_cast<int>(to - from));
      from = to;
    }
    return counts;
  }

  std::size_t place_of_edge(Edge edge) const {
    return static_cast<std::size_t>(std::lower_bound(edges_.begin(), edges_.end(), edge) -
                                    edges_.begin());
  }

  Vec3 corner(int vertex) const { return used_x_[place_of(vertex, used_)]; }

  void number_edges() {
    constexpr std::size_t tets_at_once = std::size_t{1} << 17;
    const std::vector<std::array<int, 4>>& tets = old_.rows.tets;
    for (std::size_t first = 0; first < tets.size(); first += tets_at_once) {
      for (std::size_t t = first; t < std::min(tets.size(), first + tets_at_once); ++t)
        for (const auto& e : tet_edges) wanted_.push_back(edge_of(tets[t][e[0]], tets[t][e[1]]));
      sort_once(wanted_);
    }
    edges_ = exchange(comm_, wanted_, edges_by_rank(wanted_)).items;
    sort_once(edges_);
    const auto mine = static_cast<long long>(edges_.size());
    first_number_ = old_.vertices + sum_before(comm_, mine);
    const long long edges = global_sum(comm_, mine);
    new_ = {old_.comm, {}, old_.vertices + edges, 8 * old_.tets, 4 * old_.triangles};
    constexpr long long most = std::numeric_limits<int>::max();
    TUNICA_CHECK(new_.vertices <= most, "refinement: the result would have " +
                                            std::to_string(new_.vertices) +
                                            " vertices, more than can be numbered");
    new_.rows.regions = old_.rows.regions;
    new_.rows.surfaces = old_.rows.surfaces;
  }

  /// Places of the middles where the edges are numbered, and from there to whoever has them.
  void fetch_middles() {
    std::vector<int> ends;
    for (const Edge edge : edges_) ends.push_back(upper_end(edge));
    sort_once(ends);
    const std::vector<Vec3> x = fetch(comm_, ends, old_.rows.vertices, old_.vertices);
    const long long first = old_.place().first_vertex;
    edge_x_.reserve(edges_.size());
    for (const Edge edge : edges_)
      edge_x_.push_back(
          0.5 * (old_.rows.vertices[lower_end(edge) - first] + x[place_of(upper_end(edge), ends)]));
    const Received<Edge> asked = exchange(comm_, wanted_, edges_by_rank(wanted_));
    std::vector<Middle> answers;
    answers.reserve(asked.items.size());
    for (const Edge edge : asked.items) {
      const std::size_t k = place_of_edge(edge);
      answers.push_back({static_cast<int>(first_number_ + static_cast<long long>(k)), edge_x_[k]});
    }
    middles_ = exchange(comm_, answers, asked.counts).items;
  }

  const Middle& middle(int a, int b) const {
    const auto found = std::lower_bound(wanted_.begin(), wanted_.end(), edge_of(a, b));
    return middles_[static_cast<std::size_t>(found - wanted_.begin())];
  }

  void split_tets() {
    const Mesh& rows = old_.rows;
    Mesh fine;
    fine.tets.reserve(8 * rows.tets.size());
    for (const auto& tet : rows.tets) {
      std::array<int, 10> numbers{};
      std::array<Vec3, 10> x;
      for (int i = 0; i < 4; ++i) {
        numbers[i] = tet[i];
        x[i] = corner(tet[i]);
      }
      for (int e = 0; e < 6; ++e) {
        const Middle& m = middle(tet[tet_edges[e][0]], tet[tet_edges[e][1]]);
        numbers[4 + e] = m.number;
        x[4 + e] = m.x;
      }
      for (const auto& c : children_of(x))
        fine.tets.push_back({numbers[c[0]], numbers[c[1]], numbers[c[2]], numbers[c[3]]});
    }
    const long long first = 8 * old_.place().first_tet;
    new_.rows.tets = spread(comm_, fine.tets, first, new_.tets);
    const auto inherited = [&](const auto& values) {
      std::decay_t<decltype(values)> of_children;
      of_children.reserve(8 * values.size());
      for (const auto& value : values) of_children.insert(of_children.end(), 8, value);
      return spread(comm_, of_children, first, new_.tets);
    };
    new_.rows.tet_region = inherited(rows.tet_region);
    for (const TetVectors& vectors : rows.tet_vectors)
      new_.rows.tet_vectors.push_back({vectors.name, inherited(vectors.values)});
  }

  /// A rank may have a triangle without its tetrahedra, and so without the middles of its edges.
  void split_triangles() {
    const Mesh& rows = old_.rows;
    std::vector<Edge> edges;
    for (const auto& v : rows.triangles)
      for (int e = 0; e < 3; ++e) edges.push_back(edge_of(v[e], v[(e + 1) % 3]));
    sort_once(edges);
    const Received<Edge> asked = exchange(comm_, edges, edges_by_rank(edges));
    std::vector<int> numbers;
    on_all(comm_, [&] {
      for (const Edge edge : asked.items) {
        const std::size_t k = place_of_edge(edge);
        TUNICA_CHECK(k < edges_.size() && edges_[k] == edge,
                     "refinement: a triangle has an edge between vertices " +
                         std::to_string(lower_end(edge)) + " and " +
                         std::to_string(upper_end(edge)) + ", which no tetrahedron has");
        numbers.push_back(static_cast<int>(first_number_ + static_cast<long long>(k)));
      }
    });
    const std::vector<int> number = exchange(comm_, numbers, asked.counts).items;
    const auto middle_of = [&](int a, int b) {
      return number[std::lower_bound(edges.begin(), edges.end(), edge_of(a, b)) - edges.begin()];
    };
    std::vector<std::array<int, 3>> triangles;
    std::vector<int> surfaces;
    for (std::size_t i = 0; i < rows.triangles.size(); ++i) {
      const auto& v = rows.triangles[i];
      const int m01 = middle_of(v[0], v[1]), m12 = middle_of(v[1], v[2]),
                m20 = middle_of(v[2], v[0]);
      triangles.insert(triangles.end(),
                       {{v[0], m01, m20}, {m01, v[1], m12}, {m20, m12, v[2]}, {m01, m12, m20}});
      surfaces.insert(surfaces.end(), 4, rows.triangle_surface[i]);
    }
    const long long first = 4 * old_.place().first_triangle;
    new_.rows.triangles = spread(comm_, triangles, first, new_.triangles);
    new_.rows.triangle_surface = spread(comm_, surfaces, first, new_.triangles);
  }

  double cylinder_radius(int surface) const {
    const Mesh& rows = old_.rows;
    std::vector<std::array<int, 3>> its;
    for (std::size_t i = 0; i < rows.triangles.size(); ++i)
      if (rows.triangle_surface[i] == surface) its.push_back(rows.triangles[i]);
    double low = std::numeric_limits<double>::max(), high = 0.0;
    for (const Vec3& x : fetch(comm_, vertices_of(its), rows.vertices, old_.vertices)) {
      low = std::min(low, std::hypot(x[0], x[1]));
      high = std::max(high, std::hypot(x[0], x[1]));
    }
    low = global_min(comm_, low);
    high = global_max(comm_, high);
    TUNICA_CHECK(high - low <= most_radius_spread * high && high > 0.0,
                 "refinement: surface \"" + rows.surfaces[surface].name +
                     "\" is no cylinder about the z axis: its radii range from " + show(low) +
                     " to " + show(high) + ". Do not project it.");
    return 0.5 * (low + high);
  }

  void check_volumes(const std::vector<std::string>& projected) const {
    const Mesh& rows = new_.rows;
    const std::vector<int> used = vertices_of(rows.tets);
    const std::vector<Vec3> x = fetch(comm_, used, rows.vertices, new_.vertices);
    const auto at = [&](int v) { return x[place_of(v, used)]; };
    double inverted = 0.0;
    std::string first;
    for (std::size_t t = 0; t < rows.tets.size(); ++t) {
      const auto& v = rows.tets[t];
      if (signed_volume(at(v[0]), at(v[1]), at(v[2]), at(v[3])) > 0.0) continue;
      if (inverted++ == 0.0)
        first = show(at(v[0])) + " in region \"" + rows.regions[rows.tet_region[t]].name + "\"";
    }
    const double all = global_sum(comm_, inverted);
    on_all(comm_, [&] {
      if (inverted == 0.0) return;
      std::string names;
      for (const std::string& name : projected)
        names += (names.empty() ? "\"" : ", \"") + name + "\"";
      throw Error("refinement: the projection of " + names + " inverts " +
                  std::to_string(static_cast<long long>(all)) + " elements, the first at " + first +
                  ". Refine without projection, or project all surfaces of the thin layers.");
    });
  }

  const Slab& old_;
  const Comm& comm_;
  std::vector<int> used_;  ///< vertices of the rank's tetrahedra
  std::vector<Vec3> used_x_;
  std::vector<Edge> wanted_;     ///< edges of the rank's tetrahedra
  std::vector<Middle> middles_;  ///< theirs
  std::vector<Edge> edges_;      ///< that the rank numbers, from first_number_ on
  std::vector<Vec3> edge_x_;     ///< their middles
  long long first_number_ = 0;
  Slab new_;
};

}  // namespace

Slab refine(const Slab& slab, const std::vector<std::string>& project) {
  Refinement refinement(slab);
  for (const std::string& surface : project) refinement.project(surface);
  return refinement.take(project);
}

}  // namespace tunica::mesh
