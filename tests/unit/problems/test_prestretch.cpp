// A wall whose elements have a prestretch.

#include <Teuchos_UnitTestHarness.hpp>

#include "tunica/assembly/gather.hpp"
#include "tunica/base/error.hpp"
#include "tunica/base/reduce.hpp"
#include "tunica/kernels/deformation.hpp"
#include "tunica/problems/prestress_balance.hpp"
#include "tunica/problems/solid_problem.hpp"
#include "tunica/problems/surface_radius.hpp"
#include "unit/problems/lists.hpp"

namespace {

using namespace tunica;
using problems::SolidProblem;
using test::SmallTube;

/// An artery of two layers, clamped at both ends, under pressure.
Teuchos::ParameterList artery(const std::string& analysis) {
  auto list = test::wall_list();
  for (const char* end : {"struct_in", "struct_out"}) test::condition(list, end, "clamped");
  test::condition(list, "interface", "pressure").set("pressure", 2.0);
  auto& layers = list.sublist("Layers");
  layers.sublist("media").set("law", std::string("holzapfel"));
  layers.sublist("adventitia").set("law", std::string("holzapfel")).set("c10", 0.3);
  auto& frame = list.sublist("Fibre Frame").set("kind", std::string("laplace"));
  frame.sublist("Linear Solver").set("method", std::string("direct"));
  list.set("analysis", analysis);
  list.set("stabilisation residual", std::string("linear"));  // as where a Prestress is found
  return test::resolved(list, problems::solid_table());
}

/// I + ∇d of the elements where local nodes lie at x.
std::vector<Mat3> gradients(const fields::FieldMesh& mesh, const std::vector<Vec3>& d) {
  const assembly::ElementGeometry geometry(mesh, mesh.x);
  std::vector<Mat3> F;
  for (std::size_t e = 0; e < mesh.tets.size(); ++e)
    F.push_back(kernels::deformation_gradient(geometry[e], assembly::gather(d, mesh.tets[e])));
  return F;
}

std::vector<Vec3> on_nodes(const SmallTube& tube, int seed, double size) {
  const std::vector<int> ends{tube.surface("struct_in"), tube.surface("struct_out")};
  const auto x = test::free_part(tube.wall, test::scattered(tube.wall, seed, size), ends);
  return fields::ghosted_vectors(tube.wall, x[0]);
}

std::vector<int> ends_of(const SmallTube& tube) {
  return {tube.surface("struct_in"), tube.surface("struct_out")};
}

TEUCHOS_UNIT_TEST(prestretch, jacobian_is_the_derivative_of_the_residual) {
  const SmallTube tube;
  for (const std::string analysis : {"dynamic", "static"}) {
    SolidProblem wall(artery(analysis), tube.wall);
    TEST_ASSERT(
        wall.field().set_prestretch(gradients(tube.wall, on_nodes(tube, 7, 0.03))).is_success());
    wall.begin_step(stepping::Clock(0.125, 1));
    const auto x = test::free_part(tube.wall, test::scattered(wall, 1, 0.01), ends_of(tube));
    const auto v = test::free_part(tube.wall, test::scattered(wall, 2), ends_of(tube));
    TEST_COMPARE(test::jacobian_error(wall, x, v, 1e-7), <, 1e-6);
  }
}

// Without what is on its surfaces, which lies on the mesh.

TEUCHOS_UNIT_TEST(prestretch, of_a_shape_is_as_if_the_wall_were_meshed_in_that_shape) {
  const SmallTube tube;
  Teuchos::ParameterList list = artery("static");
  list.sublist("Surfaces").remove("interface");
  const std::vector<Vec3> e = on_nodes(tube, 3, 0.03);
  fields::FieldMesh image = tube.wall;
  for (std::size_t a = 0; a < image.x.size(); ++a) image.x[a] += e[a];

  SolidProblem from_shape(list, tube.wall);
  // Directions of the shape's fibres in the image: there the prestretch takes them back.
  std::vector<materials::Frame> frames = from_shape.field().frames();
  const std::vector<Mat3> G = gradients(tube.wall, e);
  for (std::size_t t = 0; t < frames.size(); ++t) {
    frames[t].circumferential = unit(G[t] * frames[t].circumferential);
    frames[t].axial = unit(G[t] * frames[t].axial);
  }
  SolidProblem pushed(list, image, frames);
  TEST_ASSERT(pushed.field().set_prestretch(G).is_success());

  algebra::BlockVector D =
      test::free_part(tube.wall, test::scattered(pushed, 5, 0.02), ends_of(tube));
  algebra::BlockVector d(pushed.space()), R(pushed.space()), R_shape(pushed.space());
  d.assign(D);
  D[0].update(
      1.0,
      [&] {
        Vector nodal(tube.wall.vector_map);
        fields::store({e.begin(), e.begin() + tube.wall.n_owned}, tube.wall, nodal);
        return nodal;
      }(),
      1.0);
  for (SolidProblem* wall : {&from_shape, &pushed}) wall->begin_step(stepping::Clock(1.0, 1));
  TEST_ASSERT(from_shape.residual(D, R_shape).is_success());
  TEST_ASSERT(pushed.residual(d, R).is_success());
  for (int b = 0; b < 2; ++b) {
    const double size = R_shape[b].norm2();
    TEST_COMPARE(size, >, 0.0);
    R[b].update(-1.0, R_shape[b], 1.0);
    TEST_COMPARE(R[b].norm2(), <, 1e-10 * size);
  }
}

// K s of a wall that stays on its mesh is the derivative of the residual along
// G ← (I + h sym ∇s) G. Fibres keep their directions in the mesh.

TEUCHOS_UNIT_TEST(prestretch, jacobian_on_the_mesh_is_the_derivative_by_the_prestretch) {
  const SmallTube tube;
  SolidProblem wall(artery("static"), tube.wall);
  wall.field().stay_on_mesh();
  const std::vector<Mat3> G = gradients(tube.wall, on_nodes(tube, 7, 0.03));
  TEST_ASSERT(wall.field().set_prestretch(G).is_success());  // gives fibres their directions
  const std::vector<Vec3> s = on_nodes(tube, 4, 1.0);
  algebra::BlockVector x(wall.space()), v(wall.space()), Kv(wall.space());
  x[1].assign(test::scattered(wall, 6, 0.1)[1]);
  Vector nodal(tube.wall.vector_map);
  fields::store({s.begin(), s.begin() + tube.wall.n_owned}, tube.wall, nodal);
  v[0].assign(nodal);

  constexpr double h = 1e-6;
  std::vector<algebra::BlockVector> R;
  for (const double sign : {1.0, -1.0}) {
    std::vector<Vec3> moved(s);
    for (Vec3& m : moved) m = sign * h * m;
    std::vector<Mat3> stretched = gradients(tube.wall, moved);
    for (std::size_t e = 0; e < G.size(); ++e) stretched[e] = symmetric_part(stretched[e]) * G[e];
    TEST_ASSERT(wall.field().set_prestretch(stretched).is_success());
    wall.begin_step(stepping::Clock(1.0, 1));
    R.emplace_back(wall.space());
    TEST_ASSERT(wall.residual(x, R.back()).is_success());
  }
  TEST_ASSERT(wall.field().set_prestretch(G).is_success());
  wall.begin_step(stepping::Clock(1.0, 1));
  wall.jacobian(x);
  wall.apply_jacobian(v, Kv);
  for (int b = 0; b < 2; ++b) {
    Vector& error = R[0][b];
    error.update(-0.5 / h, R[1][b], 0.5 / h);
    error.update(-1.0, Kv[b], 1.0);
    TEST_COMPARE(Kv[b].norm2(), >, 0.0);
    TEST_COMPARE(error.norm2(), <, 1e-6 * Kv[b].norm2());
  }
}

TEUCHOS_UNIT_TEST(prestretch, stays_with_the_wall_where_it_is_saved) {
  const SmallTube tube;
  Teuchos::ParameterList list = artery("dynamic");
  list.sublist("Prestress").set("pressure", 1.0);
  SolidProblem wall(list, tube.wall), other(list, tube.wall);
  const std::vector<Mat3> G = gradients(tube.wall, on_nodes(tube, 7, 0.03));
  TEST_ASSERT(wall.field().set_prestretch(G).is_success());
  for (const auto& [name, part] : other.inner_parts())
    TEST_EQUALITY(part->restore(wall.inner_parts().at(name)->save()), "");
  TEST_ASSERT(other.field().prestretch() == G);  // of shared elements, too
  for (std::size_t e = 0; e < G.size(); ++e)
    TEST_ASSERT(other.field().elements().frames[e].axial ==
                wall.field().elements().frames[e].axial);
  Teuchos::ParameterList without = artery("dynamic");
  SolidProblem plain(without, tube.wall);
  TEST_THROW(plain.restore(wall.save()), Error);
}

TEUCHOS_UNIT_TEST(prestretch, that_inverts_an_element_is_refused_with_its_place) {
  const SmallTube tube;
  SolidProblem wall(artery("static"), tube.wall);
  std::vector<Mat3> G(tube.wall.tets.size(), identity());
  for (std::size_t e = 0; e < G.size(); ++e)
    if (tube.wall.tet_number[e] == tube.wall.tet_number[0] && tube.wall.comm->getRank() == 0)
      G[e][0][0] = -0.5;
  const std::string reason = wall.field().set_prestretch(G).reason();
  TEST_INEQUALITY(reason.find("is inverted (det G = -0.5)"), std::string::npos);
  TEST_INEQUALITY(reason.find(" of \""), std::string::npos);
}

TEUCHOS_UNIT_TEST(prestretch, radius_of_a_tube_is_found_from_its_inside) {
  const SmallTube tube;
  const double radius = problems::surface_radius(tube.wall, {tube.surface("interface")});
  double exact = 0.0;
  for (int a = 0; a < tube.wall.n_owned; ++a)
    if (tube.wall.is_on(a, tube.surface("interface")))
      exact = std::hypot(tube.wall.x[a][0], tube.wall.x[a][1]);
  exact = global_max(*tube.wall.comm, exact);
  out << radius << " of " << exact << "\n";
  TEST_COMPARE(std::abs(radius - exact), <, 0.1 * exact);
}

// Where the wall lies without stress, R is what loads make of it: λ times as much at a part λ of
// them.
TEUCHOS_UNIT_TEST(prestretch, a_body_force_is_raised_with_the_other_loads) {
  const SmallTube tube;
  auto list = artery("static");
  const auto at = [&](double load) {
    const SolidProblem wall(list, tube.wall);
    problems::PrestressBalance balance(list, wall);
    algebra::BlockVector R(wall.state().space());
    TEST_ASSERT(!balance.residual(load, wall.state(), R).is_failure());
    return R;
  };
  const auto pressed = at(1.0);
  test::set_vector(list, "body force", {0.1, 0.2, -0.3});
  const auto all = at(1.0), half = at(0.5), none = at(0.0);
  TEST_COMPARE(none[0].normInf(), <, 1e-14 * all[0].normInf());
  Vector difference(half[0], Teuchos::Copy);
  difference.update(-0.5, all[0], 1.0);
  TEST_COMPARE(difference.normInf(), <, 1e-14 * all[0].normInf());
  difference.update(1.0, all[0], -1.0, pressed[0], 0.0);
  TEST_COMPARE(difference.normInf(), >, 0.0);
}

}  // namespace
