#include <Teuchos_UnitTestHarness.hpp>

#include "tunica/assembly/mass_norm.hpp"
#include "unit/fields/small_tube.hpp"

namespace {

using namespace tunica;
using test::SmallTube;

double volume_of_fluid(const mesh::Mesh& mesh) {
  double volume = 0.0;
  for (std::size_t e = 0; e < mesh.tets.size(); ++e) {
    const auto& t = mesh.tets[e];
    if (mesh.tet_region[e] == 0)
      volume += signed_volume(mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]],
                              mesh.vertices[t[3]]);
  }
  return volume;
}

TEUCHOS_UNIT_TEST(mass_norm, of_constants_is_the_root_of_the_volume) {
  const SmallTube tube;
  const auto geometry = assembly::ElementGeometry(tube.fluid, tube.fluid.x);
  const double root = std::sqrt(volume_of_fluid(tube.mesh));
  const auto norm = [&](const Vec3& u, double p) {
    return assembly::mass_norm(
        tube.fluid, geometry,
        test::block_vector(tube.fluid, [&](int, int i) { return i < 3 ? u[i] : p; }));
  };
  TEST_FLOATING_EQUALITY(norm({1, 0, 0}, 0), root, 1e-13);
  TEST_FLOATING_EQUALITY(norm({0, 0, 0}, -2), 2 * root, 1e-13);
  TEST_FLOATING_EQUALITY(norm({1, 1, 1}, 1), 2 * root, 1e-13);
  TEST_EQUALITY(norm({0, 0, 0}, 0), 0.0);
}

TEUCHOS_UNIT_TEST(mass_norm, of_a_linear_function_is_exact) {
  // ∫ z² over a prism of length L is A L³/3 = V L²/3.
  const SmallTube tube;
  const auto geometry = assembly::ElementGeometry(tube.fluid, tube.fluid.x);
  const auto x = test::block_vector(
      tube.fluid, [&](int v, int i) { return i == 3 ? tube.mesh.vertices[v][2] : 0.0; });
  TEST_FLOATING_EQUALITY(assembly::mass_norm(tube.fluid, geometry, x),
                         std::sqrt(volume_of_fluid(tube.mesh) * 9.0 / 3.0), 1e-13);
}

TEUCHOS_UNIT_TEST(mass_norm, does_not_depend_on_the_ranks) {
  const SmallTube many, one(test::alone());
  const auto norm = [](const SmallTube& tube) {
    return assembly::mass_norm(tube.wall, assembly::ElementGeometry(tube.wall, tube.wall.x),
                               test::scattered(tube.wall, 3));
  };
  TEST_FLOATING_EQUALITY(norm(many), norm(one), 1e-13);
}

TEUCHOS_UNIT_TEST(element_geometry, is_that_of_where_the_nodes_are) {
  const SmallTube tube;
  std::vector<Vec3> x = tube.fluid.x;
  const assembly::ElementGeometry geometry(tube.fluid, x);
  TEST_EQUALITY(geometry.size(), tube.fluid.tets.size());
  for (std::size_t e = 0; e < geometry.size(); ++e) {
    x = tube.fluid.x;
    const double before = geometry[e].volume;
    for (Vec3& at : x) at = 2.0 * at;
    TEST_FLOATING_EQUALITY(geometry[e].volume, 8.0 * before, 1e-14);
  }
}

}  // namespace
