#include "tunica/fields/locate.hpp"

#include <cmath>

#include "tunica/base/reduce.hpp"
#include "tunica/fields/simplex.hpp"

namespace tunica::fields {

namespace {

constexpr double vertex_share = 1e-6;  ///< of an edge: what is nearer to a vertex is the vertex

template <std::size_t n>
double longest_edge(const std::array<Vec3, n>& x) {
  double longest = 0.0;
  for (std::size_t a = 0; a < n; ++a)
    for (std::size_t b = 0; b < a; ++b) longest = std::max(longest, norm(x[a] - x[b]));
  return longest;
}

bool is_near_box(const std::array<Vec3, 4>& x, const Vec3& point) {
  for (int i = 0; i < 3; ++i) {
    const auto [low, high] = std::minmax({x[0][i], x[1][i], x[2][i], x[3][i]});
    const double margin = weight_round_off * (high - low);
    if (point[i] < low - margin || point[i] > high + margin) return false;
  }
  return true;
}

/// Puts the place into a vertex that is next to it.
void snap_to_vertex(Place& place) {
  for (int a = 0; a < 4; ++a)
    if (place.weights[a] >= 1.0 - vertex_share) {
      place.weights = {};
      place.weights[a] = 1.0;
      return;
    }
}

/// The rank's place in a tetrahedron that it counts; the number of that, infinite where the point
/// lies in none.
double place_inside(const FieldMesh& mesh, const Vec3& point, Place& place) {
  for (std::size_t e = 0; e < mesh.tets.size(); ++e) {
    if (!mesh.is_owned[e]) continue;
    std::array<Vec3, 4> x;
    for (int a = 0; a < 4; ++a) x[a] = mesh.x[mesh.tets[e][a]];
    if (!is_near_box(x, point)) continue;
    const std::array<double, 4> weights = weights_in(x, point);
    if (!is_inside(weights)) continue;
    place = {true, mesh.tets[e], weights, 0.0, point, longest_edge(x)};
    return static_cast<double>(mesh.tet_number[e]);  // they ascend
  }
  return 1e300;
}

/// The rank's place on a boundary triangle that it counts, and its distance from the point.
double place_on_boundary(const FieldMesh& mesh, const Vec3& point, Place& place) {
  double smallest = 1e300;
  for (const Face& face : mesh.faces) {
    if (!face.is_owned) continue;
    std::array<Vec3, 3> x;
    for (int a = 0; a < 3; ++a) x[a] = mesh.x[face.nodes[a]];
    const std::array<double, 3> w = nearest_on(x, point);
    const Vec3 foot = point_of(w, x);
    const double distance = norm(point - foot);
    if (distance >= smallest) continue;
    smallest = distance;
    place = {true,
             {face.nodes[0], face.nodes[1], face.nodes[2], face.nodes[0]},
             {w[0], w[1], w[2], 0.0},
             distance,
             foot,
             longest_edge(x)};
  }
  return smallest;
}

/// Leaves the place to the rank of the smallest measure, the first of several.
void agree(const Comm& comm, double measure, Place& place) {
  const bool is_best = measure == global_min(comm, measure);
  const double first = global_min(comm, is_best ? comm.getRank() : comm.getSize());
  place.is_here = first == comm.getRank();
  const Vec3 at = place.is_here ? place.position : Vec3{};
  const double distance = place.is_here ? place.distance : 0.0;
  const double length = place.is_here ? place.element_length : 0.0;
  const auto all = global_sum(comm, {at[0], at[1], at[2], distance, length});
  place.position = {all[0], all[1], all[2]};
  place.distance = all[3];
  place.element_length = all[4];
}

}  // namespace

Place locate(const FieldMesh& mesh, const Vec3& point) {
  Place place{};
  double measure = place_inside(mesh, point, place);
  if (global_min(*mesh.comm, measure) == 1e300) measure = place_on_boundary(mesh, point, place);
  agree(*mesh.comm, measure, place);
  snap_to_vertex(place);
  return place;
}

}  // namespace tunica::fields
