#include <Teuchos_UnitTestHarness.hpp>

#include "tunica/fields/locate.hpp"
#include "unit/fields/small_tube.hpp"

namespace {

using namespace tunica;
using fields::Place;
using test::SmallTube;
using test::world;

/// On the one rank that holds the place.
double value_at(const Place& place, const std::vector<double>& nodal) {
  return global_sum(*world(), place.is_here ? place.value(nodal) : 0.0);
}

double ranks_with(const Place& place) { return global_sum(*world(), place.is_here ? 1.0 : 0.0); }

double linear(const Vec3& x) { return 0.7 + 1.3 * x[0] - 2.1 * x[1] + 0.4 * x[2]; }

template <class Function>
std::vector<double> nodal_values(const fields::FieldMesh& mesh, const Function& f) {
  std::vector<double> values;
  for (const Vec3& x : mesh.x) values.push_back(f(x));
  return values;
}

TEUCHOS_UNIT_TEST(locate, linear_fields_are_exact_at_any_point) {
  const SmallTube tube;
  const auto values = nodal_values(tube.fluid, linear);
  for (int k = 0; k < 40; ++k) {
    const double r = 1.3 * std::abs(test::scatter(k)), phi = 3.1 * test::scatter(k + 100);
    const Vec3 x{r * std::cos(phi), r * std::sin(phi), 1.5 + 1.5 * test::scatter(k + 200)};
    const Place place = fields::locate(tube.fluid, x);
    TEST_EQUALITY(ranks_with(place), 1.0);
    TEST_EQUALITY(place.distance, 0.0);
    TEST_COMPARE(std::abs(value_at(place, values) - linear(x)), <, 1e-12);
  }
}

TEUCHOS_UNIT_TEST(locate, a_vertex_has_its_own_value) {
  const SmallTube tube;
  const auto cubic = [](const Vec3& x) { return x[0] * x[1] * x[2] + std::exp(x[0]); };
  const auto values = nodal_values(tube.wall, cubic);
  for (std::size_t v = 0; v < tube.mesh.vertices.size(); v += 7) {
    const Vec3 x = tube.mesh.vertices[v];
    if (std::hypot(x[0], x[1]) < 1.43 - 1e-9) continue;
    for (const Vec3& near : {x, x + Vec3{1e-8, -2e-8, 1e-8}}) {
      const Place place = fields::locate(tube.wall, near);
      TEST_EQUALITY(ranks_with(place), 1.0);
      TEST_EQUALITY(value_at(place, values), cubic(x));
    }
  }
}

TEUCHOS_UNIT_TEST(locate, a_point_outside_is_moved_to_the_nearest_one_and_tells_how_far) {
  const SmallTube tube;
  const auto values = nodal_values(tube.fluid, linear);
  struct Case {
    Vec3 point, nearest;
  };
  const double flat = 1.43 * std::cos(M_PI / 8.0);  // of the octagon's sides from the axis
  const Vec3 side{flat * std::cos(M_PI / 8.0), flat * std::sin(M_PI / 8.0), 1.1};
  const Vec3 outward{std::cos(M_PI / 8.0), std::sin(M_PI / 8.0), 0.0};
  for (const Case& c : {Case{{0.3, 0.2, -0.5}, {0.3, 0.2, 0.0}},     // a face
                        Case{side + 0.01 * outward, side},           // a face, between two vertices
                        Case{{2.0, 0.0, 1.2}, {1.43, 0.0, 1.2}},     // an edge
                        Case{{2.0, 0.0, 3.5}, {1.43, 0.0, 3.0}}}) {  // a vertex
    const Place place = fields::locate(tube.fluid, c.point);
    TEST_EQUALITY(ranks_with(place), 1.0);
    TEST_FLOATING_EQUALITY(place.distance, norm(c.point - c.nearest), 1e-12);
    TEST_COMPARE(norm(place.position - c.nearest), <, 1e-12);
    TEST_COMPARE(std::abs(value_at(place, values) - linear(c.nearest)), <, 1e-12);
    TEST_COMPARE(place.element_length, >, 0.3);
  }
}

TEUCHOS_UNIT_TEST(locate, each_field_has_its_own_points) {
  const SmallTube tube;
  const Vec3 in_fluid{0.1, 0.2, 1.0};
  TEST_EQUALITY(fields::locate(tube.fluid, in_fluid).distance, 0.0);
  TEST_COMPARE(fields::locate(tube.wall, in_fluid).distance, >, 1.0);
}

}  // namespace
