#include <Teuchos_UnitTestHarness.hpp>

#include "tunica/assembly/element_geometry.hpp"
#include "tunica/assembly/viscous_residual.hpp"
#include "tunica/materials/newtonian.hpp"
#include "unit/fields/small_tube.hpp"
#include "verify/cube.hpp"
#include "verify/field_of.hpp"

namespace {

using namespace tunica;
using test::SmallTube;

template <class Velocity>
std::vector<Vec3> viscous_forces_of(const fields::FieldMesh& mesh, const Velocity& velocity) {
  std::vector<Vec3> u;
  for (const Vec3& x : mesh.x) u.push_back(velocity(x));
  return assembly::viscous_forces(mesh, assembly::ElementGeometry(mesh, mesh.x),
                                  materials::Newtonian(0.7), u);
}

TEUCHOS_UNIT_TEST(viscous_forces, vanish_where_strain_rates_are_uniform) {
  const SmallTube tube;
  const auto shear = [](const Vec3& x) { return Vec3{2.0 * x[1] - x[2], x[0], 3.0 * x[2]}; };
  for (const Vec3& force : viscous_forces_of(tube.fluid, shear))
    TEST_COMPARE(norm(force), <, 1e-12);
}

TEUCHOS_UNIT_TEST(viscous_forces, are_exact_inside_a_regular_mesh_for_parabolas) {
  // div 2με = μ (Δu + ∇ div u) with Δu = (2, 0, 6) and div u = z − z
  const fields::FieldMesh cube = verify::field_of(verify::make_cube(8));
  const auto parabola = [](const Vec3& x) {
    return Vec3{x[1] * x[1] + x[0] * x[2], -x[1] * x[2], 3.0 * x[0] * x[0]};
  };
  const std::vector<Vec3> forces = viscous_forces_of(cube, parabola);
  int count = 0;
  for (std::size_t e = 0; e < forces.size(); ++e) {
    bool is_inside = true;
    for (const int a : cube.tets[e])
      for (const double s : cube.x[a]) is_inside &= s > 0.2 && s < 0.8;
    if (!is_inside) continue;
    ++count;
    TEST_COMPARE(norm(forces[e] - 0.7 * Vec3{2.0, 0.0, 6.0}), <, 1e-10);
  }
  TEST_COMPARE(count, >, 10);
}

TEUCHOS_UNIT_TEST(viscous_forces, do_not_depend_on_the_ranks) {
  const SmallTube many, one(test::alone());
  const auto swirl = [](const Vec3& x) { return Vec3{x[1] * x[2], std::sin(x[0]), x[0] * x[1]}; };
  const std::vector<Vec3> mine = viscous_forces_of(many.fluid, swirl),
                          all = viscous_forces_of(one.fluid, swirl);
  for (std::size_t e = 0; e < mine.size(); ++e)
    for (std::size_t k = 0; k < all.size(); ++k)
      if (many.fluid.tet_number[e] == one.fluid.tet_number[k])
        TEST_COMPARE(norm(mine[e] - all[k]), <, 1e-12);
}

}  // namespace
