#include <Teuchos_UnitTestHarness.hpp>
#include <random>

#include "tunica/fields/simplex.hpp"
#include "tunica/fields/tet_search.hpp"
#include "tunica/mesh/block.hpp"

namespace {

using namespace tunica;
using fields::TetSearch;

/// A block of 2 × 1 × 1 mm; the half with x > 1 is region 1.
struct SearchedBlock {
  SearchedBlock() : mesh(mesh::make_block({{2.0, 1.0, 1.0}, {7, 4, 5}})) {
    for (const auto& tet : mesh.tets) {
      double x = 0.0;
      for (const int v : tet) x += 0.25 * mesh.vertices[v][0];
      region.push_back(x > 1.0 ? 1 : 0);
    }
  }
  TetSearch search() const { return {mesh.vertices, mesh.tets, region}; }

  mesh::Mesh mesh;
  std::vector<int> region;
};

Vec3 point_at(const TetSearch::Spot& spot, const mesh::Mesh& mesh) {
  Vec3 sum{};
  for (int a = 0; a < 4; ++a) sum += spot.weights[a] * mesh.vertices[spot.vertices[a]];
  return sum;
}

TEUCHOS_UNIT_TEST(tet_search, finds_points_where_they_are) {
  const SearchedBlock block;
  const TetSearch search = block.search();
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (int k = 0; k < 500; ++k) {
    const Vec3 point{2.0 * unit(random), unit(random), unit(random)};
    const auto spot = search.find(point);
    TEST_EQUALITY(spot.distance, 0.0);
    TEST_COMPARE(norm(point_at(spot, block.mesh) - point), <, 1e-12);
  }
}

TEUCHOS_UNIT_TEST(tet_search, gives_the_nearest_place_of_a_point_outside) {
  const SearchedBlock block;
  const TetSearch search = block.search();
  // The nearest point of a box is known: each coordinate is cut off.
  for (const Vec3& point :
       {Vec3{-0.3, 0.4, 0.2}, Vec3{2.5, 1.7, -0.1}, Vec3{1.2, 0.3, 40.0}, Vec3{-1e3, -1e3, 0.5}}) {
    const Vec3 nearest{std::clamp(point[0], 0.0, 2.0), std::clamp(point[1], 0.0, 1.0),
                       std::clamp(point[2], 0.0, 1.0)};
    const auto spot = search.find(point);
    TEST_FLOATING_EQUALITY(spot.distance, norm(point - nearest), 1e-12);
    TEST_COMPARE(norm(point_at(spot, block.mesh) - nearest), <, 1e-9);
  }
}

TEUCHOS_UNIT_TEST(tet_search, stays_within_a_region) {
  const SearchedBlock block;
  const TetSearch search = block.search();
  const Vec3 point{0.25, 0.5, 0.5};
  TEST_EQUALITY(search.find(point, 0).distance, 0.0);
  double edge = 2.0;  // of region 1, whose elements are those with centres beyond the middle
  for (std::size_t e = 0; e < block.mesh.tets.size(); ++e)
    if (block.region[e] == 1)
      for (const int v : block.mesh.tets[e]) edge = std::min(edge, block.mesh.vertices[v][0]);
  const double distance = search.find(point, 1).distance;
  TEST_COMPARE(distance, >=, edge - point[0] - 1e-12);
  TEST_COMPARE(distance, <, 1.0);
}

TEUCHOS_UNIT_TEST(simplex, nearest_points_of_a_tetrahedron_are_those_of_a_fine_sample) {
  const std::array<Vec3, 4> x{Vec3{0, 0, 0}, Vec3{1, 0.1, 0}, Vec3{0.2, 1, 0}, Vec3{0.3, 0.2, 0.9}};
  constexpr int n = 40;
  for (const Vec3& point : {Vec3{2, 2, 2}, Vec3{-1, 0.2, 0.3}, Vec3{0.4, 0.3, -1},
                            Vec3{0.3, 0.3, 0.2}, Vec3{0.3, 0.1, 3}}) {
    double smallest = 1e300;
    for (int i = 0; i <= n; ++i)
      for (int j = 0; i + j <= n; ++j)
        for (int k = 0; i + j + k <= n; ++k) {
          const std::array<double, 4> w{i / double(n), j / double(n), k / double(n),
                                        (n - i - j - k) / double(n)};
          smallest = std::min(smallest, norm(point - fields::point_of(w, x)));
        }
    const double found = norm(point - fields::point_of(fields::nearest_in(x, point), x));
    TEST_COMPARE(found, <=, smallest + 1e-12);
    TEST_COMPARE(found, >=, smallest - 1.8 / n);
  }
}

}  // namespace
