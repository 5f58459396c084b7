#include <Teuchos_UnitTestHarness.hpp>
#include <cmath>

#include "tunica/assembly/gather.hpp"
#include "tunica/base/error.hpp"
#include "tunica/base/reduce.hpp"
#include "tunica/kernels/surface_tri3.hpp"
#include "tunica/multigrid/muelu/cycle.hpp"
#include "tunica/problems/solid_problem.hpp"
#include "unit/problems/lists.hpp"

namespace {

using namespace tunica;
using problems::SolidProblem;
using test::SmallTube;

Teuchos::ParameterList clamped() {
  auto list = test::wall_list();
  test::condition(list, "struct_in", "clamped");
  test::condition(list, "struct_out", "clamped");
  return list;
}

/// The same with the two layers of an artery.
Teuchos::ParameterList artery() {
  auto list = clamped();
  auto& layers = list.sublist("Layers");
  layers.sublist("media").set("law", std::string("holzapfel"));
  layers.sublist("adventitia").set("law", std::string("holzapfel"));
  layers.sublist("adventitia").set("c10", 0.3).set("k1", 0.562).set("k2", 0.7112);
  layers.sublist("adventitia").set("fibre angle", 62.0).set("dispersion", 0.1);
  auto& frame = list.sublist("Fibre Frame").set("kind", std::string("laplace"));
  frame.sublist("Linear Solver").set("method", std::string("direct"));
  return list;
}

Teuchos::ParameterList resolved(const Teuchos::ParameterList& list) {
  return test::resolved(list, problems::solid_table());
}

TEUCHOS_UNIT_TEST(solid_problem, jacobian_is_the_derivative_of_the_residual) {
  const SmallTube tube;
  auto list = clamped();
  test::condition(list, "interface", "pressure").set("pressure", 2.0);  // follows the surface
  test::set_vector(test::condition(list, "outer", "traction"), "traction", {0.1, 0.2, 0.3});
  const std::vector<int> fixed{tube.surface("struct_in"), tube.surface("struct_out")};
  for (const std::string analysis : {"dynamic", "static"}) {
    list.set("analysis", analysis);
    SolidProblem wall(resolved(list), tube.wall);
    wall.begin_step(stepping::Clock(0.125, 1));
    const auto x = test::free_part(tube.wall, test::scattered(tube.wall, 1, 0.005), fixed);
    for (int direction = 2; direction < 5; ++direction) {
      const auto v = test::free_part(tube.wall, test::scattered(tube.wall, direction), fixed);
      TEST_COMPARE(test::jacobian_error(wall, x, v, 1e-6), <, 1e-6);
    }
  }
}

/// Of a tube under pressure after one step, found by solves to a tolerance.
std::vector<Vec3> inflated(const SmallTube& tube, const std::string& far_end, bool is_exact) {
  Teuchos::ParameterList list = test::wall_list();
  test::condition(list, "struct_in", "clamped");
  test::condition(list, "struct_out", far_end);
  test::condition(list, "interface", "pressure").set("pressure", 2.0);
  if (!is_exact) {  // sweeps that solve nothing exactly, not even the rows of what is prescribed
    auto muelu = multigrid::mixed_cycle_list(1);
    muelu.sublist("Factories").sublist("Sweeps").set("damping", 0.6);
    muelu.sublist("Hierarchy").set("coarse: max size", 40);
    auto& solver = list.sublist("Linear Solver").set("method", std::string("gcr"));
    solver.set("preconditioner", std::string("multigrid")).sublist("MueLu") = muelu;
  }
  list.sublist("Newton").set("linear tolerance", is_exact ? 1e-8 : 0.1);
  list.sublist("Newton").set("relative increment", 0.0).set("absolute increment", 1e-13);
  SolidProblem wall(resolved(list), tube.wall);
  wall.begin_step(stepping::Clock(0.125, 1));
  const auto report = wall.solve();
  TUNICA_CHECK(report.is_converged, report.reason);
  return wall.displacement();
}

TEUCHOS_UNIT_TEST(solid_problem, inexact_solves_leave_what_is_prescribed_where_it_is) {
  const SmallTube tube;
  const Comm& comm = *tube.wall.comm;
  for (const std::string far_end : {"clamped", "moves as one"}) {
    const auto exact = inflated(tube, far_end, true), found = inflated(tube, far_end, false);
    double strayed = 0.0, distance = 0.0, largest = 0.0;
    Vec3 low{1e300, 1e300, 1e300}, high{-1e300, -1e300, -1e300};
    for (int a = 0; a < tube.wall.n_owned; ++a) {
      if (tube.wall.is_on(a, tube.surface("struct_in")))
        strayed = std::max(strayed, norm(found[a]));
      if (tube.wall.is_on(a, tube.surface("struct_out")))
        for (int i = 0; i < 3; ++i) {
          low[i] = std::min(low[i], found[a][i]);
          high[i] = std::max(high[i], found[a][i]);
        }
      distance = std::max(distance, norm(found[a] - exact[a]));
      largest = std::max(largest, norm(exact[a]));
    }
    TEST_EQUALITY(global_max(comm, strayed), 0.0);
    for (int i = 0; i < 3; ++i) TEST_EQUALITY(global_max(comm, high[i]), global_min(comm, low[i]));
    TEST_EQUALITY(far_end == "clamped", global_max(comm, high[2]) == 0.0);
    TEST_COMPARE(global_max(comm, largest), >, 1e-4);
    TEST_COMPARE(global_max(comm, distance), <, 1e-9 * global_max(comm, largest));
  }
}

TEUCHOS_UNIT_TEST(solid_problem, jacobian_with_fibres_is_the_derivative_of_the_residual) {
  const SmallTube tube;
  const std::vector<int> fixed{tube.surface("struct_in"), tube.surface("struct_out")};
  SolidProblem wall(resolved(artery()), tube.wall);
  wall.begin_step(stepping::Clock(0.125, 1));
  TEST_ASSERT(wall.split() != nullptr);
  const auto x = test::free_part(tube.wall, test::scattered(wall, 1, 0.02), fixed);
  for (int direction = 2; direction < 5; ++direction) {
    const auto v = test::free_part(tube.wall, test::scattered(wall, direction), fixed);
    TEST_COMPARE(test::jacobian_error(wall, x, v, 1e-7), <, 1e-6);
  }
}

TEUCHOS_UNIT_TEST(solid_problem, fibres_out_of_all_bounds_are_refused) {
  const SmallTube tube;
  auto list = artery();
  list.sublist("Layers").sublist("media").set("k2", 1e9);
  SolidProblem wall(resolved(list), tube.wall);
  wall.begin_step(stepping::Clock(0.125, 1));
  const auto x = test::scattered(wall, 1, 0.02);
  algebra::BlockVector F(wall.space());
  TEST_ASSERT(wall.residual(x, F).is_failure() || !std::isfinite(test::norm(F)));
}

TEUCHOS_UNIT_TEST(solid_problem, at_rest_nothing_moves_and_no_energy_is_stored) {
  const SmallTube tube;
  SolidProblem wall(resolved(clamped()), tube.wall);
  wall.begin_step(stepping::Clock(0.125, 1));
  TEST_ASSERT(wall.solve().is_converged);
  const auto found = wall.observe();
  for (const std::string name : {"max_displacement_wall_mm", "wall_pressure_min_kPa",
                                 "wall_pressure_max_kPa", "elastic_energy_kPa_mm3"})
    TEST_COMPARE(std::abs(test::observed(found, name)), <, 1e-14);
  TEST_FLOATING_EQUALITY(test::observed(found, "min_det_F"), 1.0, 1e-14);
  TEST_FLOATING_EQUALITY(test::observed(found, "max_det_F"), 1.0, 1e-14);
}

TEUCHOS_UNIT_TEST(solid_problem, a_wall_that_falls_freely_has_the_energy_of_its_speed) {
  const SmallTube tube;
  auto list = test::wall_list();
  list.set("time scheme", std::string("newmark"));
  list.sublist("Newmark").set("beta", 0.25).set("gamma", 0.5);
  const Vec3 g{0.1, 0.0, -0.2};
  test::set_vector(list, "body force", g);
  SolidProblem wall(resolved(list), tube.wall);
  wall.begin_step(stepping::Clock(0.5, 1));
  TEST_ASSERT(wall.solve().is_converged);
  wall.end_step();
  // From rest without acceleration to g in the first step: half of g on average.
  const double speed = 0.5 * norm(g) * 0.5, height = 4.0 * std::sin(M_PI / 4.0) * 3.0;
  const double volume = height * (1.82 * 1.82 - 1.43 * 1.43);
  const auto found = wall.observe();
  TEST_FLOATING_EQUALITY(test::observed(found, "wall_kinetic_energy_kPa_mm3"),
                         0.5 * 1.2 * volume * speed * speed, 1e-9);
  TEST_COMPARE(std::abs(test::observed(found, "elastic_energy_kPa_mm3")), <, 1e-12);
  TEST_COMPARE(std::abs(test::observed(found, "volumetric_energy_kPa_mm3")), <, 1e-12);
}

TEUCHOS_UNIT_TEST(solid_problem, a_traction_and_its_nodal_forces_do_the_same) {
  const SmallTube tube;
  const Vec3 t{0.02, 0.0, 0.01};
  auto loaded = clamped();
  test::set_vector(test::condition(loaded, "outer", "traction"), "traction", t);
  SolidProblem by_traction(resolved(loaded), tube.wall), by_forces(resolved(clamped()), tube.wall);
  std::vector<Vec3> force(tube.wall.n_owned);  // area/3 to each node of a face
  for (const auto& face : tube.wall.faces) {
    if (face.surface != tube.surface("outer")) continue;
    const double area = norm(kernels::area_normal(assembly::gather(tube.wall.x, face.nodes)));
    for (const int a : face.nodes)
      if (a < tube.wall.n_owned) force[a] += area / 3.0 * t;
  }
  by_forces.field().set_nodal_force(force);
  for (SolidProblem* wall : {&by_traction, &by_forces}) {
    wall->begin_step(stepping::Clock(0.125, 1));
    TEST_ASSERT(wall->solve().is_converged);
  }
  TEST_COMPARE(test::norm(by_traction.state()), >, 1e-4);
  TEST_COMPARE(test::relative_difference(by_forces.state(), by_traction.state()), <, 1e-8);
}

TEUCHOS_UNIT_TEST(solid_problem, clamped_and_held_components_stay) {
  const SmallTube tube;
  auto list = test::wall_list();
  test::condition(list, "struct_in", "clamped");
  test::condition(list, "struct_out", "held")
      .set("components", Teuchos::Array<std::string>(1, "z"));
  test::condition(list, "interface", "pressure").set("pressure", 0.05);
  SolidProblem wall(resolved(list), tube.wall);
  wall.begin_step(stepping::Clock(0.125, 1));
  TEST_ASSERT(wall.solve().is_converged);
  const auto d = wall.displacement();
  double moved = 0.0;
  for (int a = 0; a < tube.wall.n_owned; ++a) {
    if (tube.wall.is_on(a, tube.surface("struct_in"))) TEST_EQUALITY(norm(d[a]), 0.0);
    if (!tube.wall.is_on(a, tube.surface("struct_out"))) continue;
    TEST_EQUALITY(d[a][2], 0.0);
    moved = std::max(moved, norm(d[a]));
  }
  TEST_COMPARE(global_max(*test::world(), moved), >, 1e-5);
}

TEUCHOS_UNIT_TEST(solid_problem, layers_have_their_own_density_bulk_modulus_and_law) {
  const SmallTube tube;
  auto list = clamped();
  auto& layers = list.sublist("Layers");
  layers.sublist("media").set("density", 1.0).set("bulk modulus", 100.0);
  layers.sublist("adventitia").set("density", 2.0).set("c10", 6.0);
  list.set("pressure at layers", std::string("continuous")).set("stabilisation at layers", 1.0);
  list.set("time scheme", std::string("newmark"));
  SolidProblem wall(resolved(list), tube.wall);
  wall.begin_step(stepping::Clock(0.5, 1));
  const auto& elements = wall.field().elements();
  for (std::size_t e = 0; e < tube.wall.tets.size(); ++e) {
    const bool is_media = tube.wall.regions[tube.wall.region[e]] == "media";
    const auto c = elements.coefficients(e);
    TEST_EQUALITY(elements.layer(e).density, is_media ? 1.0 : 2.0);
    TEST_FLOATING_EQUALITY(c.alpha, (is_media ? 1.0 : 2.0) / (0.625 * 0.25), 1e-14);
    TEST_EQUALITY(c.inv_kappa, is_media ? 0.01 : 1e-5);
    const double mu = is_media ? 2.0 * 3.3 : 2.0 * 6.3;
    TEST_FLOATING_EQUALITY(elements.layer(e).law->stabilisation_modulus(), mu, 1e-14);
    const double h = kernels::element_length(elements.geometry[e].volume);
    TEST_FLOATING_EQUALITY(c.tau, 1.0 / (4.0 * mu / (h * h) + c.alpha), 1e-13);
  }
}

TEUCHOS_UNIT_TEST(solid_problem, the_papers_stabilisation_ignores_inertia) {
  const SmallTube tube;
  auto list = clamped();
  list.set("stabilisation", std::string("paper"));
  list.set("stabilisation modulus factor", 0.5);
  SolidProblem wall(resolved(list), tube.wall);
  wall.begin_step(stepping::Clock(0.5, 1));
  const auto& elements = wall.field().elements();
  for (std::size_t e = 0; e < tube.wall.tets.size(); ++e) {
    const double h = kernels::element_length(elements.geometry[e].volume);
    TEST_FLOATING_EQUALITY(elements.tau[e], h * h / (4.0 * 0.5 * 6.6), 1e-13);
  }
}

TEUCHOS_UNIT_TEST(solid_problem, stabilisation_is_weaker_where_materials_meet_on_any_ranks) {
  mesh::Tube options = SmallTube::options();
  options.media_layers = 3;
  const mesh::Mesh mesh = mesh::make_tube(options);
  const auto field = fields::make_field_mesh(test::share_of(mesh, {true, false, false}), {1, 2});
  auto list = clamped();
  list.set("stabilisation", std::string("paper"));
  const auto weak = [&](const Teuchos::ParameterList& wanted) {
    SolidProblem wall(resolved(wanted), field);
    wall.begin_step(stepping::Clock(0.5, 1));
    const auto& elements = wall.field().elements();
    std::vector<char> is_weak;
    for (std::size_t e = 0; e < field.tets.size(); ++e) {
      const double h = kernels::element_length(elements.geometry[e].volume);
      const double mu = elements.layer(e).law->stabilisation_modulus();
      is_weak.push_back(elements.tau[e] * 4.0 * mu / (h * h) < 0.9);
      TEST_FLOATING_EQUALITY(elements.tau[e] * 4.0 * mu / (h * h), is_weak[e] ? 0.2 : 1.0, 1e-12);
    }
    return is_weak;
  };
  list.set("pressure at layers", std::string("continuous")).set("stabilisation at layers", 0.2);
  for (const char flag : weak(list)) TEST_ASSERT(!flag);  // the same material in both layers
  list.sublist("Layers").sublist("adventitia").set("c10", 0.3);
  const auto flags = weak(list);
  for (std::size_t e = 0; e < field.tets.size(); ++e) {
    bool touches = false;
    for (const int a : field.tets[e])
      touches = touches || std::abs(std::hypot(field.x[a][0], field.x[a][1]) - 1.69) < 1e-9;
    TEST_EQUALITY(bool(flags[e]), touches);
  }
}

TEUCHOS_UNIT_TEST(solid_problem, an_inverting_displacement_is_refused_on_all_ranks_alike) {
  const SmallTube tube, serial(test::alone());
  const auto refusal = [](const SmallTube& t) {
    SolidProblem wall(resolved(clamped()), t.wall);
    wall.begin_step(stepping::Clock(0.125, 1));
    const auto x = test::scattered(t.wall, 3, 0.3);  // no two elements alike
    algebra::BlockVector F = fields::zero_vector(t.wall);
    return wall.residual(x, F).reason();
  };
  TEST_ASSERT(refusal(serial).find("element ") == 0);
  TEST_EQUALITY(refusal(tube), refusal(serial));
}

TEUCHOS_UNIT_TEST(solid_problem, a_displacement_that_is_no_number_is_refused_with_its_element) {
  const SmallTube tube;
  SolidProblem wall(resolved(clamped()), tube.wall);
  wall.begin_step(stepping::Clock(0.125, 1));
  algebra::BlockVector x = fields::zero_vector(tube.wall), F = fields::zero_vector(tube.wall);
  if (tube.wall.comm->getRank() == 0) x[0].replaceLocalValue(0, std::nan(""));
  TEST_ASSERT(wall.residual(x, F).reason().find("nan") != std::string::npos);
}

TEUCHOS_UNIT_TEST(solid_problem, a_step_does_not_depend_on_the_ranks) {
  const SmallTube many, one(test::alone());
  const auto solved = [](const SmallTube& tube, Teuchos::ParameterList list) {
    test::condition(list, "interface", "pressure").set("pressure", 0.1);
    SolidProblem wall(resolved(list), tube.wall);
    stepping::Clock clock(0.125, 2);
    for (; !clock.is_done(); clock.advance()) {
      wall.begin_step(clock);
      wall.solve();
      wall.end_step();
    }
    std::vector<double> found = test::by_vertex(tube.wall, wall.state(), tube.mesh.vertices.size());
    std::vector<double> pressures(2 * tube.mesh.vertices.size(), 0.0);  // also between layers
    const auto p = wall.state()[1].getLocalViewHost(read_only);
    for (int a = 0; a < wall.scalar_mesh().n_owned; ++a)
      pressures[wall.scalar_mesh().vertex[a]] = p(a, 0);
    pressures = global_sum(*tube.wall.comm, pressures);
    found.insert(found.end(), pressures.begin(), pressures.end());
    return found;
  };
  for (const auto& list : {clamped(), artery()})
    TEST_COMPARE(test::largest_difference(solved(many, list), solved(one, list)), <, 1e-9);
}

TEUCHOS_UNIT_TEST(solid_problem, vertices_between_materials_have_a_pressure_for_each) {
  const SmallTube tube;
  SolidProblem one(resolved(clamped()), tube.wall), two(resolved(artery()), tube.wall);
  auto list = artery();
  list.set("pressure at layers", std::string("continuous"));
  SolidProblem continuous(resolved(list), tube.wall);
  const auto unknowns = [](const SolidProblem& wall) { return wall.space()->n_unknowns(); };
  TEST_EQUALITY(unknowns(one), unknowns(continuous));
  TEST_EQUALITY(unknowns(two) - unknowns(one), 8 * 4);  // around, along
  TEST_ASSERT(one.split() == nullptr && continuous.split() == nullptr);
  for (int a = 0; a < two.split()->n_owned; ++a)
    TEST_ASSERT(two.split()->copy[a] == 0 ||
                std::abs(std::hypot(two.split()->x[a][0], two.split()->x[a][1]) - 1.69) < 1e-9);
}

TEUCHOS_UNIT_TEST(solid_problem, goes_on_from_a_saved_state) {
  for (auto list : {clamped(), artery()}) {
    const SmallTube tube;
    test::condition(list, "interface", "pressure").set("pressure", 0.5);
    SolidProblem wall(resolved(list), tube.wall), other(resolved(list), tube.wall);
    stepping::Clock clock(0.125, 3);
    const auto step = [&clock](SolidProblem& one) {
      one.begin_step(clock);
      const bool is_converged = one.solve().is_converged;
      one.end_step();
      return is_converged;
    };
    TEST_ASSERT(step(wall));
    clock.advance();
    TEST_EQUALITY(test::take_over(wall, other), "");
    TEST_ASSERT(other.displacement() == wall.displacement());
    TEST_ASSERT(step(wall) && step(other));
    TEST_ASSERT(other.displacement() == wall.displacement());
    TEST_ASSERT(other.velocity() == wall.velocity());
  }
}

TEUCHOS_UNIT_TEST(solid_problem, does_not_go_on_with_another_number_of_pressures) {
  const SmallTube tube;
  auto list = artery();
  SolidProblem two(resolved(list), tube.wall);
  list.set("pressure at layers", std::string("continuous"));
  SolidProblem one(resolved(list), tube.wall);
  TEST_THROW(one.restore(two.save()), Error);
  TEST_THROW(two.restore(one.save()), Error);
}

}  // namespace
