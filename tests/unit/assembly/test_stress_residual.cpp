#include <Teuchos_UnitTestHarness.hpp>

#include "tunica/assembly/stress_residual.hpp"
#include "tunica/materials/mooney_rivlin.hpp"
#include "unit/fields/small_tube.hpp"
#include "verify/cube.hpp"
#include "verify/field_of.hpp"

namespace {

using namespace tunica;

const materials::MooneyRivlin law(3.0, 0.0);

/// Of a displacement of the mesh, all of it of one law.
template <class Displacement>
std::vector<Vec3> forces_of(const fields::FieldMesh& mesh, const Displacement& displacement) {
  assembly::SolidElements elements;
  elements.geometry = assembly::ElementGeometry(mesh, mesh.x);
  elements.layers = {{&law, 1.0}};
  elements.layer_number.assign(mesh.tets.size(), 0);
  std::vector<Vec3> d;
  for (const Vec3& x : mesh.x) d.push_back(displacement(x));
  return assembly::stress_forces(assembly::PatchRecovery(mesh), mesh, elements, d);
}

TEUCHOS_UNIT_TEST(stress_forces, vanish_where_the_wall_is_stretched_uniformly) {
  const fields::FieldMesh cube = verify::field_of(verify::make_cube(3));
  const auto stretch = [](const Vec3& x) { return Vec3{0.3 * x[0] + 0.1 * x[1], 0.2 * x[2], 0.0}; };
  for (const Vec3& force : forces_of(cube, stretch)) TEST_COMPARE(norm(force), <, 1e-11);
}

TEUCHOS_UNIT_TEST(stress_forces, are_those_of_linear_elasticity_where_strains_are_small) {
  // div σ' = μ (Δd + ∇ div d/3), Δd = ε (2, 0, 6), div d = 0, inside a regular mesh
  constexpr double epsilon = 1e-6;
  const fields::FieldMesh cube = verify::field_of(verify::make_cube(8));
  const std::vector<Vec3> forces = forces_of(cube, [](const Vec3& x) {
    return Vec3{epsilon * x[1] * x[1], 0.0, epsilon * 3.0 * x[0] * x[0]};
  });
  double largest = 0.0, count = 0.0;
  for (std::size_t e = 0; e < forces.size(); ++e) {
    bool is_inside = true;
    for (const int a : cube.tets[e])
      for (const double s : cube.x[a]) is_inside &= s > 0.3 && s < 0.7;
    if (!is_inside) continue;
    count += 1.0;
    largest = std::max(largest, norm(1.0 / epsilon * forces[e] - 3.0 * Vec3{2.0, 0.0, 6.0}));
  }
  TEST_COMPARE(global_sum(*cube.comm, count), >, 10.0);
  TEST_COMPARE(largest, <, 1e-4);
}

TEUCHOS_UNIT_TEST(stress_forces, do_not_depend_on_the_ranks) {
  const test::SmallTube many, one(test::alone());
  const auto swirl = [](const Vec3& x) {
    return Vec3{0.1 * x[1] * x[2], 0.1 * std::sin(x[0]), 0.05 * x[0] * x[1]};
  };
  const std::vector<Vec3> mine = forces_of(many.wall, swirl), all = forces_of(one.wall, swirl);
  for (std::size_t e = 0; e < mine.size(); ++e)
    for (std::size_t k = 0; k < all.size(); ++k)
      if (many.wall.tet_number[e] == one.wall.tet_number[k])
        TEST_COMPARE(norm(mine[e] - all[k]), <, 1e-10 * (1.0 + norm(all[k])));
}

}  // namespace
