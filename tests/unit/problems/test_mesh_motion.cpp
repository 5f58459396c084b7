#include <Teuchos_UnitTestHarness.hpp>
#include <cmath>

#include "tunica/problems/mesh_motion.hpp"
#include "tunica/stepping/implicit_euler.hpp"
#include "unit/problems/lists.hpp"

namespace {

using namespace tunica;
using test::SmallTube;

Teuchos::ParameterList solved_by(const std::string& method) {
  Teuchos::ParameterList list;
  list.sublist("Linear Solver").set("method", method);
  return test::resolved(list, problems::mesh_motion_table());
}

Vec3 linear_field(const Vec3& x) {
  return {0.1 * x[0] - 0.02 * x[2], 0.3 + 0.05 * x[1] + 0.01 * x[0], 0.04 * x[2]};
}

const stepping::ImplicitEuler scheme(1);

double largest(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  double found = 0.0;
  for (std::size_t k = 0; k < a.size(); ++k) found = std::max(found, norm(a[k] - b[k]));
  return global_max(*test::world(), found);
}

TEUCHOS_UNIT_TEST(mesh_motion, a_linear_field_on_the_whole_boundary_is_reproduced_inside) {
  const SmallTube tube;
  for (const std::string method : {"cg", "direct"}) {
    problems::MeshMotion motion(
        solved_by(method), tube.fluid,
        {tube.surface("inlet"), tube.surface("outlet"), tube.surface("interface")}, scheme);
    std::vector<Vec3> given(tube.fluid.n_owned), expected(tube.fluid.n_nodes());
    for (int a = 0; a < tube.fluid.n_nodes(); ++a) expected[a] = linear_field(tube.fluid.x[a]);
    for (int a = 0; a < tube.fluid.n_owned; ++a)
      given[a] = tube.fluid.is_on_boundary(a) ? expected[a] : Vec3{7, 7, 7};  // 7 is ignored
    TEST_ASSERT(motion.extend(given).is_success());
    TEST_COMPARE(largest(motion.displacement(), expected), <, 1e-10);
  }
}

TEUCHOS_UNIT_TEST(mesh_motion, other_surfaces_stay_and_the_interface_moves_as_given) {
  const SmallTube tube;
  problems::MeshMotion motion(solved_by("cg"), tube.fluid, {tube.surface("interface")}, scheme);
  std::vector<Vec3> given(tube.fluid.n_owned);
  for (int a = 0; a < tube.fluid.n_owned; ++a) given[a] = linear_field(tube.fluid.x[a]);
  TEST_ASSERT(motion.extend(given).is_success());
  const auto& d = motion.displacement();
  bool moves_inside = false;
  for (int a = 0; a < tube.fluid.n_nodes(); ++a) {
    if (tube.fluid.is_on(a, tube.surface("interface")))
      TEST_ASSERT(d[a] == linear_field(tube.fluid.x[a]))
    else if (tube.fluid.is_on_boundary(a))
      TEST_ASSERT(d[a] == Vec3{})
    else
      moves_inside = moves_inside || norm(d[a]) > 1e-3;
  }
  TEST_ASSERT(global_max(*test::world(), moves_inside) > 0.5);
}

TEUCHOS_UNIT_TEST(mesh_motion, the_tolerance_asked_for_is_enough_and_no_number_is_a_failure) {
  const SmallTube tube;
  const std::vector<Vec3> given(tube.fluid.n_owned, Vec3{0.01, 0.02, 0.03});
  Teuchos::ParameterList loose = solved_by("cg");
  loose.sublist("Linear Solver").set("tolerance", 1e-4);
  problems::MeshMotion coarse(loose, tube.fluid, {tube.surface("interface")}, scheme);
  TEST_ASSERT(coarse.extend(given).is_success());
  problems::MeshMotion motion(solved_by("cg"), tube.fluid, {tube.surface("interface")}, scheme);
  const std::vector<Vec3> nowhere(tube.fluid.n_owned, Vec3{std::nan(""), 0, 0});
  TEST_ASSERT(motion.extend(nowhere).reason().find("relative residual") != std::string::npos);
}

TEUCHOS_UNIT_TEST(mesh_motion, the_old_displacement_is_that_of_the_last_accepted_step) {
  const SmallTube tube;
  problems::MeshMotion motion(solved_by("direct"), tube.fluid, {tube.surface("interface")}, scheme);
  const std::vector<Vec3> zero(tube.fluid.n_nodes());
  const std::vector<Vec3> given(tube.fluid.n_owned, Vec3{0.01, 0.02, 0.03});
  TEST_ASSERT(motion.extend(given).is_success());
  const std::vector<Vec3> first = motion.displacement();
  TEST_EQUALITY(largest(motion.old_displacement(), zero), 0.0);
  motion.end_step();
  TEST_ASSERT(motion.extend(std::vector<Vec3>(tube.fluid.n_owned)).is_success());
  TEST_EQUALITY(largest(motion.old_displacement(), first), 0.0);
  TEST_COMPARE(largest(motion.displacement(), zero), <, 1e-12);
}

TEUCHOS_UNIT_TEST(mesh_motion, goes_on_from_a_saved_state) {
  const SmallTube tube;
  problems::MeshMotion motion(solved_by("cg"), tube.fluid, {tube.surface("interface")}, scheme);
  problems::MeshMotion other(solved_by("cg"), tube.fluid, {tube.surface("interface")}, scheme);
  std::vector<Vec3> given(tube.fluid.n_owned);
  for (int a = 0; a < tube.fluid.n_owned; ++a) given[a] = linear_field(tube.fluid.x[a]);
  TEST_ASSERT(motion.extend(given).is_success());
  motion.end_step();
  TEST_EQUALITY(other.restore(motion.save()), "");
  TEST_ASSERT(other.displacement() == motion.displacement());
  TEST_ASSERT(other.old_displacement() == motion.old_displacement());
  for (Vec3& d : given) d = 1.1 * d;
  TEST_ASSERT(motion.extend(given).is_success() && other.extend(given).is_success());
  TEST_COMPARE(largest(other.displacement(), motion.displacement()), <, 1e-13);
}

TEUCHOS_UNIT_TEST(mesh_motion, its_discretisation_has_the_same_solution) {
  const SmallTube tube;
  discretisation::MeshMotion motion(tube.fluid);
  problems::MeshMotion solved(solved_by("direct"), tube.fluid, {tube.surface("interface")}, scheme);
  std::vector<Vec3> given(tube.fluid.n_owned);
  for (int a = 0; a < tube.fluid.n_owned; ++a)
    if (tube.fluid.is_on(a, tube.surface("interface"))) given[a] = linear_field(tube.fluid.x[a]);
  TEST_ASSERT(solved.extend(given).is_success());

  // F(d) = 0 is linear: K (d_given − d) = F(d_given)
  algebra::BlockVector start(motion.space()), end(motion.space()), F(motion.space()),
      Kd(motion.space());
  fields::store(given, tube.fluid, start[0]);
  fields::store(solved.displacement(), tube.fluid, end[0]);
  TEST_ASSERT(motion.residual(end, F).is_success());
  TEST_COMPARE(F[0].normInf(), <, 1e-11);
  TEST_ASSERT(motion.residual(start, F).is_success());
  TEST_COMPARE(F[0].normInf(), >, 1e-3);
  motion.assemble_jacobian(start);
  end[0].update(1.0, start[0], -1.0);
  motion.jacobian().apply(end, Kd);
  Kd[0].update(-1.0, F[0], 1.0);
  TEST_COMPARE(Kd[0].normInf(), <, 1e-11);
  TEST_COMPARE(motion.mass_norm(end), >, 0.0);
}

}  // namespace
