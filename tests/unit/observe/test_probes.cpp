#include <Teuchos_UnitTestHarness.hpp>

#include "tunica/base/error.hpp"
#include "tunica/observe/fluid_field.hpp"
#include "tunica/observe/probes.hpp"
#include "tunica/observe/wall_field.hpp"
#include "unit/problems/lists.hpp"

namespace {

using namespace tunica;
using observe::Probes;
using test::SmallTube;

void add_probe(Teuchos::ParameterList& list, const std::string& name, const std::string& quantity,
               const Vec3& position) {
  test::set_vector(list.sublist("Probes").sublist(name).set("quantity", quantity), "position",
                   position);
}

Vec3 displacement(const Vec3& x) {
  return {0.01 * x[2], 0.02 * x[0] - 0.01, 0.03 * x[1] + 0.002 * x[2]};
}
Vec3 velocity(const Vec3& x) { return {0.3 * x[1], 1.0 - 0.2 * x[2], 0.1 * x[0] + 0.5 * x[1]}; }
double pressure(const Vec3& x) { return 0.7 + 1.3 * x[0] - 2.1 * x[1] + 0.4 * x[2]; }

/// Displacement of the wall, velocity and pressure of the fluid, linear in space.
struct LinearFields {
  LinearFields()
      : fluid(test::resolved(test::fluid_list(1.0, 0.1), problems::fluid_table()), tube.fluid),
        wall(test::resolved(test::wall_list(), problems::solid_table()), tube.wall) {
    fields::State of_fluid = fluid.save(), of_wall = wall.save();
    for (int a = 0; a < tube.fluid.n_owned; ++a) {
      of_fluid.arrays["pressure"].values[a] = pressure(tube.fluid.x[a]);
      for (int i = 0; i < 3; ++i)
        of_fluid.arrays["velocity"].values[3 * a + i] = velocity(tube.fluid.x[a])[i];
    }
    for (int a = 0; a < tube.wall.n_owned; ++a)
      for (int i = 0; i < 3; ++i)
        of_wall.arrays["displacement"].values[3 * a + i] = displacement(tube.wall.x[a])[i];
    fluid.restore(of_fluid);
    wall.restore(of_wall);
  }
  /// As a run has them.
  std::vector<std::unique_ptr<observe::Field>> as_fields() {
    std::vector<std::unique_ptr<observe::Field>> all;
    all.push_back(std::make_unique<observe::WallField>(wall, std::vector<std::string>()));
    all.push_back(
        std::make_unique<observe::FluidField>(observe::ShearAverages{0.0}, fluid, nullptr));
    return all;
  }

  SmallTube tube;
  problems::FluidProblem fluid;
  problems::SolidProblem wall;
};

std::map<std::string, fields::FieldMesh> meshes_of(const SmallTube& tube) {
  return {{"fluid", tube.fluid}, {"wall", tube.wall}};
}

TEUCHOS_UNIT_TEST(probes, linear_fields_are_exact_between_the_vertices) {
  LinearFields run;
  const Vec3 in_fluid{0.31, -0.27, 1.234}, in_wall{1.5, 0.2, 0.777}, vertex{1.43, 0.0, 1.0};
  Teuchos::ParameterList list;
  add_probe(list, "a", "fluid pressure", in_fluid);
  add_probe(list, "b", "wall displacement", in_wall);
  add_probe(list, "c", "radial displacement", in_wall);
  add_probe(list, "d", "wall displacement", vertex);
  add_probe(list, "e", "wall displacement y", in_wall);
  add_probe(list, "f", "fluid velocity z", in_fluid);
  const Probes probes(list, meshes_of(run.tube));
  const auto found = probes.observe(run.as_fields());
  TEST_EQUALITY(found.size(), 6);
  TEST_COMPARE(
      std::abs(test::observed(found, "wall_displacement_y_e_mm") - displacement(in_wall)[1]), <,
      1e-12);
  TEST_COMPARE(
      std::abs(test::observed(found, "fluid_velocity_z_f_mm_per_ms") - velocity(in_fluid)[2]), <,
      1e-12);
  TEST_COMPARE(std::abs(test::observed(found, "fluid_pressure_a_kPa") - pressure(in_fluid)), <,
               1e-12);
  const Vec3 moved = in_wall + displacement(in_wall);
  TEST_COMPARE(
      std::abs(test::observed(found, "wall_displacement_b_mm") - norm(displacement(in_wall))), <,
      1e-12);
  TEST_COMPARE(std::abs(test::observed(found, "radial_displacement_c_mm") -
                        (std::hypot(moved[0], moved[1]) - std::hypot(in_wall[0], in_wall[1]))),
               <, 1e-12);
  TEST_COMPARE(
      std::abs(test::observed(found, "wall_displacement_d_mm") - norm(displacement(vertex))), <,
      1e-15);
}

TEUCHOS_UNIT_TEST(probes, one_outside_its_field_is_refused_with_key_and_distance) {
  const SmallTube tube;
  const auto refusal = [&](const std::string& quantity, const Vec3& position) -> std::string {
    Teuchos::ParameterList list;
    add_probe(list, "here", quantity, position);
    try {
      Probes(list, meshes_of(tube));
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  };
  TEST_EQUALITY(refusal("fluid pressure", {2.0, 0.0, 1.2}),
                "Probes / here: \"position\" {2, 0, 1.2} lies 0.57 mm outside the undeformed "
                "fluid. The nearest point in it is {1.43, 0, 1.2}.");
  TEST_ASSERT(refusal("wall displacement", {0, 0, 1}).find("undeformed wall") != std::string::npos);
  // Digits that were not typed do not matter.
  TEST_EQUALITY(refusal("fluid pressure", {1.4301, 0.0, 1.2}), "");
  TEST_EQUALITY(refusal("wall displacement", {1.011163, 1.011163, 2.0}), "");
}

}  // namespace
