#include <Teuchos_UnitTestHarness.hpp>
#include <cmath>

#include "tunica/base/session.hpp"
#include "tunica/judge/sanity.hpp"
#include "tunica/judge/stiffness.hpp"
#include "tunica/judge/units.hpp"
#include "tunica/materials/registry.hpp"
#include "tunica/mesh/faces.hpp"
#include "tunica/mesh/info.hpp"
#include "tunica/mesh/tube.hpp"
#include "tunica/run/domain.hpp"
#include "unit/fields/small_tube.hpp"
#include "unit/judge/sanity_cases.hpp"
#include "verify/quarter_tube.hpp"

namespace {

using namespace tunica;
using test::condition;
using test::doubts;
using test::ideal_tube;
using test::number;
using test::TubeCase;

/// A corner of unit edges, and a second one far away that may be twice as large.
mesh::Mesh two_corners(double size) {
  mesh::Mesh m;
  for (const auto& [x, s] : {std::pair(0.0, 1.0), std::pair(10.0, size)}) {
    const int first = static_cast<int>(m.vertices.size());
    m.vertices.insert(m.vertices.end(), {{x, 0, 0}, {x + s, 0, 0}, {x, s, 0}, {x, 0, s}});
    m.tets.push_back({first, first + 1, first + 2, first + 3});
    m.tet_region.push_back(0);
    for (const auto& f : mesh::tet_faces) {
      m.triangles.push_back({first + f[0], first + f[1], first + f[2]});
      m.triangle_surface.push_back(0);
    }
  }
  m.regions = {{1, "fluid"}};
  m.surfaces = {{1, "skin"}};
  return m;
}

/// Round as a circle of 64 sides, with two layers of 2 and 1 elements.
mesh::Tube fine_tube() {
  mesh::Tube tube;
  tube.around = 64;
  tube.axial = 4;
  tube.length = 10.0;
  return tube;
}

judge::VesselSurfaces names_of_tube() {
  return {{"interface"}, {}, {"interface"}, {"struct_in", "struct_out"}};
}

TEUCHOS_UNIT_TEST(vessel, angles_between_faces_are_those_of_known_tetrahedra) {
  const double degrees = 180.0 / M_PI;
  TEST_FLOATING_EQUALITY(
      mesh::least_dihedral_angle({{{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}}}),
      std::acos(1.0 / 3.0) * degrees, 1e-12);
  TEST_FLOATING_EQUALITY(mesh::least_dihedral_angle({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}),
                         std::acos(1.0 / std::sqrt(3.0)) * degrees, 1e-12);
}

TEUCHOS_UNIT_TEST(vessel, pieces_and_volumes_are_counted) {
  const judge::ElementShapes shapes =
      judge::element_shapes(test::share_of(two_corners(2.0), {true}, test::alone()), {0});
  TEST_EQUALITY(shapes.tets, 2);
  TEST_COMPARE_ARRAYS(shapes.pieces, (std::vector<long long>{1, 1}));
  TEST_FLOATING_EQUALITY(shapes.volume_ratio, 8.0, 1e-14);
  TEST_FLOATING_EQUALITY(shapes.volume, 9.0 / 6.0, 1e-14);
  const mesh::Share tube = test::share_of(mesh::make_tube({}), {true, false, false});
  TEST_EQUALITY(judge::element_shapes(tube, {1, 2}).pieces.size(), 1);
  TEST_EQUALITY(judge::element_shapes(tube, {1}).pieces.size(), 1);
}

TEUCHOS_UNIT_TEST(vessel, tube_is_measured_as_it_was_made) {
  const mesh::Tube tube = fine_tube();
  const mesh::Mesh made = mesh::make_tube(tube);
  const judge::Vessel vessel =
      judge::vessel_of(test::share_of(made, {true, false, false}), {0}, {1, 2}, names_of_tube());
  TEST_FLOATING_EQUALITY(vessel.radius, tube.radius, 2e-3);
  TEST_FLOATING_EQUALITY(vessel.length, tube.length, 2e-3);
  TEST_FLOATING_EQUALITY(vessel.thickness, tube.media + tube.adventitia, 5e-3);
  TEST_EQUALITY(vessel.elements_across_lumen, tube.around / 4);
  TEST_EQUALITY(vessel.elements_across_wall, 3);
  TEST_EQUALITY(vessel.openings.size(), 2);
  TEST_EQUALITY(vessel.openings[0].wall_end, "struct_in");
  TEST_EQUALITY(vessel.openings[1].wall_end, "struct_out");
  TEST_FLOATING_EQUALITY(vessel.openings[0].area, M_PI * tube.radius * tube.radius, 5e-3);
  TEST_FLOATING_EQUALITY(vessel.region_shares[0] + vessel.region_shares[1], 1.0, 1e-12);
}

TEUCHOS_UNIT_TEST(vessel, quarter_of_a_tube_is_that_tube) {
  const mesh::Tube tube = fine_tube();
  const mesh::Mesh quarter = verify::quarter_of(mesh::make_tube(tube));
  judge::VesselSurfaces surfaces = names_of_tube();
  surfaces.lumen_planes = {"symmetry_x", "symmetry_y"};
  surfaces.wall_ends.insert(surfaces.wall_ends.end(), {"symmetry_x", "symmetry_y"});
  const judge::Vessel vessel =
      judge::vessel_of(test::share_of(quarter, {true, false, false}), {0}, {1, 2}, surfaces);
  TEST_EQUALITY(vessel.openings.size(), 2);
  TEST_EQUALITY(vessel.openings[0].wall_end, "struct_in");  // not a plane of symmetry
  TEST_FLOATING_EQUALITY(vessel.radius, tube.radius, 2e-3);
  TEST_FLOATING_EQUALITY(vessel.length, tube.length, 5e-3);
  TEST_FLOATING_EQUALITY(vessel.thickness, tube.media + tube.adventitia, 5e-3);
}

TEUCHOS_UNIT_TEST(vessel, is_the_same_on_any_number_of_ranks) {
  const CommPtr comm = all_ranks();
  const run::Domain domain = run::load_domain(TubeCase().resolved(), comm);
  if (comm->getRank() != 0) return;
  TEST_EQUALITY(domain.vessel.fluid->tets, 972);
  TEST_EQUALITY(domain.vessel.wall->tets, 3888);
  TEST_EQUALITY(domain.vessel.elements_across_wall, 3);
  TEST_EQUALITY(domain.vessel.elements_across_lumen, 2);
  TEST_EQUALITY(domain.vessel.openings.at(0).wall_end, "struct_in");
}

TEUCHOS_UNIT_TEST(stiffness, is_youngs_modulus_of_isotropic_laws) {
  const double mu = 6.0, kappa = 50.0;
  const auto law = materials::make_law("neo-hookean", {{"c10", mu}});
  TEST_FLOATING_EQUALITY(judge::circumferential_modulus(*law, kappa),
                         9.0 * kappa * mu / (3.0 * kappa + mu), 1e-5);
}

TEUCHOS_UNIT_TEST(stiffness, fibres_around_carry_and_those_along_do_not) {
  const auto modulus = [](double angle) {
    const auto law = materials::make_law(
        "holzapfel", {{"c10", 1.0}, {"k1", 10.0}, {"k2", 1.0}, {"fibre angle", angle}});
    return judge::circumferential_modulus(*law, 1e9);
  };
  // 3 c10 of the matrix; a family along the stretch adds 4 k1, two of them 8 k1.
  TEST_FLOATING_EQUALITY(modulus(0.0), 3.0 + 80.0, 1e-5);
  TEST_FLOATING_EQUALITY(modulus(90.0), 3.0, 1e-5);
}

TEUCHOS_UNIT_TEST(sanity, numbers_are_those_of_the_formulas) {
  TubeCase tube;
  tube.inlet = condition(
      "inlet", "flow rate",
      number("flow rate", "2") + test::table_of("0, 400", "0.5, 1", number("period", "800")));
  const judge::Sanity s = judge::sanity_of(tube.resolved(), ideal_tube());
  const double U = 2.0 * 0.625 / M_PI;  // the amplitude at the end, 100 ms
  TEST_FLOATING_EQUALITY(s.speed, U, 1e-12);
  TEST_FLOATING_EQUALITY(s.reynolds, U * 2.0 / 0.004, 1e-12);
  TEST_FLOATING_EQUALITY(s.womersley, std::sqrt(2.0 * M_PI / 800.0 / 0.004), 1e-12);
  TEST_FLOATING_EQUALITY(s.cfl, 2.0 * U * 1.0 / 0.2, 1e-12);
  TEST_FLOATING_EQUALITY(s.modulus, 100.0, 1e-4);
  TEST_FLOATING_EQUALITY(s.wave_speed, std::sqrt(5.0), 1e-4);
  TEST_FLOATING_EQUALITY(s.steps_per_transit, 40.0 / std::sqrt(5.0), 1e-4);
  TEST_EQUALITY(s.doubts.size(), 0);
}

TEUCHOS_UNIT_TEST(sanity, pressures_drive_what_the_least_bound_permits) {
  const auto speed = [](const std::string& pressure, const std::string& amplitude) {
    TubeCase tube;
    tube.inlet = condition("inlet", "pressure", number("pressure", pressure) + amplitude);
    return judge::sanity_of(tube.resolved(), ideal_tube()).speed;
  };
  TEST_FLOATING_EQUALITY(speed("0.001", ""), 0.001 / (8.0 * 0.004 * 40.0), 1e-12);  // Poiseuille
  // A wave, as the impulse of 1 kPa ms gives less than Δp/(ρ c).
  TEST_FLOATING_EQUALITY(speed("1", test::table_of("0, 1", "1, 0")), 1.0 / std::sqrt(5.0), 1e-4);
  TEST_FLOATING_EQUALITY(speed("20", ""), std::sqrt(40.0), 1e-12);  // Bernoulli
}

TEUCHOS_UNIT_TEST(sanity, values_in_other_units_are_doubted) {
  TubeCase tube;
  tube.viscosity = "1e-12";
  TEST_ASSERT(doubts(tube, "Fluid / viscosity is 1e-12", out));
  tube.viscosity = "0.04";  // blood in Poise
  TEST_ASSERT(doubts(tube, "0.04 P = 0.004 kPa ms", out));
  tube.viscosity = "0.004";
  TEST_ASSERT(!doubts(tube, "viscosity", out));
  tube = {};
  tube.density = "1000";
  TEST_ASSERT(doubts(tube, "1000 kg/m^3 = 1 mg/mm^3", out));
  tube = {};
  tube.inlet = condition("inlet", "pressure", number("pressure", "120"));
  TEST_ASSERT(doubts(tube, "120 mmHg = 16 kPa", out));
  TEST_ASSERT(doubts(tube, "would widen a linear wall", out));
  tube = {};
  tube.inlet = condition("inlet", "flow rate", number("flow rate", "2000"));
  TEST_ASSERT(doubts(tube, "mm^3/ms (= ml/s)", out));
  tube.inlet = condition("inlet", "flow rate", number("flow rate", "0.002"));
  TEST_ASSERT(doubts(tube, "1 l/min = 16.7 mm^3/ms", out));
  tube = {};
  tube.c10 = "1e6";
  TEST_ASSERT(doubts(tube, "media: Young's modulus", out));
  tube.c10 = "0.2";  // MPa
  TEST_ASSERT(doubts(tube, "1 MPa = 1000 kPa", out));
}

// 40 mm; waves of 2.24 mm/ms (c10 = 33.3 kPa) take 18 ms.
TEUCHOS_UNIT_TEST(sanity, times_in_seconds_are_doubted_without_a_period_too) {
  const auto flow = [](const std::string& times) {
    return condition("inlet", "flow rate",
                     number("flow rate", "2") + test::table_of(times, "0, 1, 0.3"));
  };
  TubeCase tube;
  tube.inlet = flow("0, 0.1, 0.8");
  TEST_ASSERT(doubts(tube, "the table of a flow takes 0.8 ms, less than the 17.9 ms", out));
  tube.inlet = flow("0, 100, 800");
  TEST_ASSERT(!doubts(tube, "runs through the vessel", out));
  tube.step_size = "0.008";  // 100 steps
  TEST_ASSERT(doubts(tube, "the run takes 0.8 ms, less than the 17.9 ms", out));
  tube.step_size = "0.2";
  TEST_ASSERT(!doubts(tube, "runs through the vessel", out));
}

TEUCHOS_UNIT_TEST(sanity, outlets_settle_to_the_pressure_of_their_resistances) {
  TubeCase tube;
  tube.c10 = "330";
  tube.prestress = "12";
  const auto with = [&](const std::string& flow, const std::string& outlet) {
    // A triangle: as much as is given on the mean.
    tube.inlet = condition(
        "inlet", "flow rate",
        number("flow rate", flow) + test::table_of("0, 25, 50", "0, 2, 0", number("period", "50")));
    tube.outlet = condition("outlet", "windkessel",
                            number("proximal resistance", "2") + number("distal resistance", "6") +
                                number("capacitance", "200") + outlet);
  };
  with("1.5", number("distal pressure", "1") + number("mean flow", "1.5"));
  const judge::Sanity usual = judge::sanity_of(tube.resolved(), ideal_tube());
  TEST_EQUALITY(usual.doubts.size(), 0);
  const auto row = std::find_if(usual.rows.begin(), usual.rows.end(), [](const auto& r) {
    return r.what == "mean flow, and pressure at the outlets";
  });
  TEST_ASSERT(row != usual.rows.end() && row->found == "1.5 mm^3/ms, 13 kPa = 97.5 mmHg");
  with("1.5", number("mean flow", "3"));
  TEST_ASSERT(doubts(tube, "as if 3 mm^3/ms left", out));
  with("15", "");
  TEST_ASSERT(doubts(tube, "raises the pressure to 120 kPa", out));
  with("-1.5", "");
  TEST_ASSERT(doubts(tube, "draw 1.5 mm^3/ms out", out));
  with("0.5", number("distal pressure", "-5"));
  TEST_ASSERT(doubts(tube, "settles at -1 kPa", out));
}

TEUCHOS_UNIT_TEST(sanity, loads_that_do_nothing_or_are_not_seen_are_doubted) {
  TubeCase tube;
  tube.inlet = condition("inlet", "flow rate", number("flow rate", "0"));
  TEST_ASSERT(doubts(tube, "all loads are zero", out));
  tube.wall = "<Parameter name='body force' type='Array(double)' value='{0, 9.81e-3, 0}'/>";
  TEST_ASSERT(!doubts(tube, "all loads are zero", out));
  tube = {};
  const std::string file = test::text("file", TUNICA_MESHES "/tube-tiny.h5");
  tube.inlet = condition("inlet", "velocity from file", file);
  TEST_ASSERT(!doubts(tube, "all loads are zero", out));
  const auto with_flow = [&](const std::string& amplitude) {
    tube.inlet = condition("inlet", "flow rate", number("flow rate", "2") + amplitude);
  };
  with_flow(test::table_of("0, 500, 600", "0, 0, 1"));  // begins behind the end of the run
  TEST_ASSERT(doubts(tube, "all loads are zero", out));
  with_flow(test::table_of("0, 10, 10.4, 10.8", "0, 0, 1, 0"));
  TEST_ASSERT(doubts(tube, "which the run does not resolve", out));
  with_flow(test::table_of("0, 10, 20, 30", "0, 0, 1, 0"));
  TEST_ASSERT(!doubts(tube, "which the run does not resolve", out));
  // A spline through 0, 1, 0 stays in the table; one with a long gap in its period does not.
  const std::string spline = test::text("interpolation", "spline");
  with_flow(test::table_of("0, 30, 60", "0, 1, 0", spline));
  TEST_ASSERT(!doubts(tube, "exceeds the values of its table", out));
  with_flow(test::table_of("0, 10, 20, 30", "0, 1, 1, 0.5", spline + number("period", "90")));
  TEST_ASSERT(doubts(tube, "exceeds the values of its table", out));
  TEST_ASSERT(doubts(tube, "a period of 90 ms ends 60 ms before it is repeated", out));
  // Pulses that end where they begin, and tables that end a time or two early, are complete.
  with_flow(test::table_of("0, 10, 20", "0, 1, 0", number("period", "90")));
  TEST_ASSERT(!doubts(tube, "before it is repeated", out));
  with_flow(test::table_of("0, 30, 60", "0, 1, 0.5", number("period", "90")));
  TEST_ASSERT(!doubts(tube, "before it is repeated", out));
  with_flow(test::table_of("0, 0.4", "1, 2", number("period", "0.8")));
  TEST_ASSERT(doubts(tube, "0.8 s = 800 ms", out));
}

TEUCHOS_UNIT_TEST(sanity, outlets_begin_with_the_pressure_of_the_image) {
  TubeCase tube;
  tube.prestress = "10";
  const auto outlet_of = [&](const std::string& pressure) {
    tube.outlet = condition("outlet", "windkessel",
                            number("proximal resistance", "1") + number("distal resistance", "10") +
                                number("capacitance", "1") + number("initial pressure", pressure));
  };
  outlet_of("0");
  TEST_ASSERT(doubts(tube, "outlet begins with a pressure of 0 kPa", out));
  outlet_of("9");
  TEST_ASSERT(!doubts(tube, "begins with a pressure", out));
  tube.outlet = "";  // nothing presses there
  TEST_ASSERT(doubts(tube, "the opening outlet has no condition", out));
  outlet_of("9");
  tube.prestress = "0";
  outlet_of("0");
  TEST_ASSERT(!doubts(tube, "begins with a pressure", out));
  outlet_of("9");  // 9 kPa R/(E h) = 0.9
  TEST_ASSERT(doubts(tube, "widens by about 90 % at once", out));
  TEST_ASSERT(doubts(tube, "/ pressure = 9;", out));
}

TEUCHOS_UNIT_TEST(sanity, loads_beside_the_pressure_of_the_image_are_doubted) {
  TubeCase tube;
  const auto with = [&](const std::string& load) {
    tube.ends = TubeCase().ends + test::sublist("load", test::text("surface", "interface") + load);
  };
  const std::string traction = "<Parameter type=\"Array(double)\" name=\"traction\" value=\"";
  with(test::text("condition", "pressure") + number("pressure", "10.67"));
  TEST_ASSERT(!doubts(tube, "Prestress), which", out));
  tube.prestress = "10.67";
  TEST_ASSERT(doubts(tube, "interface bears the pressure of the fluid, and one of 10.7 kPa", out));
  with(test::text("condition", "traction") + traction + "{0, 0, 10.67}\"/>");
  TEST_ASSERT(doubts(tube, "interface bears a traction of 10.7 kPa at the start", out));
  with(test::text("condition", "traction") + traction + "{0, 0, 10.67}\"/>" +
       test::table_of("0, 10", "0, 1"));
  TEST_ASSERT(!doubts(tube, "bears a traction", out));
  // A wall alone: that of the case takes its place.
  const auto alone = [&](const std::string& pressure) {
    with(test::text("condition", "pressure") + number("pressure", pressure));
    judge::Vessel wall = ideal_tube();
    wall.fluid.reset();
    Teuchos::ParameterList list = tube.resolved();
    list.remove("Fluid");
    const auto found = judge::sanity_of(list, wall).doubts;
    return std::any_of(found.begin(), found.end(), [](const std::string& doubt) {
      return doubt.find("which it replaces") != std::string::npos;
    });
  };
  TEST_ASSERT(alone("4"));
  TEST_ASSERT(!alone("10.67"));
}

TEUCHOS_UNIT_TEST(sanity, openings_without_a_condition_are_doubted_beside_outlets) {
  TubeCase tube;
  tube.outlet = "";
  TEST_ASSERT(!doubts(tube, "has no condition", out));  // one that is left free is usual
  judge::Vessel fork = ideal_tube();
  fork.openings.push_back({"branch", 1.0, 10});
  tube.outlet = condition("outlet", "resistance", number("resistance", "1"));
  const judge::Sanity s = judge::sanity_of(tube.resolved(), fork);
  const auto found = std::count_if(s.doubts.begin(), s.doubts.end(), [](const std::string& doubt) {
    return doubt.find("the opening branch has no condition") != std::string::npos;
  });
  TEST_EQUALITY(found, 1);
}

TEUCHOS_UNIT_TEST(sanity, ends_that_a_fibre_frame_does_not_know_are_doubted) {
  Teuchos::ParameterList list = TubeCase().resolved();
  Teuchos::ParameterList& frame = list.sublist("Wall").sublist("Fibre Frame");
  const auto only = [](const char* name) { return Teuchos::Array<std::string>(1, name); };
  frame.set("kind", "laplace");
  frame.set("inner surfaces", only("interface"));
  frame.set("outer surfaces", only("outer"));
  frame.set("start surfaces", only("struct_in"));
  frame.set("end surfaces", only("struct_out"));
  judge::Vessel fork = ideal_tube();
  fork.openings[0].wall_end = "struct_in";
  fork.openings[1].wall_end = "struct_out";
  TEST_EQUALITY(judge::sanity_of(list, fork).doubts.size(), 0);
  fork.openings.push_back({"branch", 1.0, 10, "struct_branch"});
  const judge::Sanity s = judge::sanity_of(list, fork);
  TEST_EQUALITY(s.doubts.size(), 1);
  TEST_EQUALITY(s.doubts.at(0).find("struct_branch, the wall's end at the opening branch"), 0);
}

TEUCHOS_UNIT_TEST(sanity, steps_that_are_too_long_are_doubted) {
  TubeCase tube;
  tube.step_size = "20";
  TEST_ASSERT(doubts(tube, "crosses about 1.3e+02 elements", out));
  tube.inlet =
      condition("inlet", "pressure", number("pressure", "0.1") + test::table_of("0, 20", "0, 1"));
  TEST_ASSERT(doubts(tube, "a wave runs through the vessel in 17.9 ms", out));
  // The first steps of a run whose load rises slowly are no reason.
  tube.step_size = "5";
  tube.inlet = condition("inlet", "pressure",
                         number("pressure", "0.1") + test::table_of("0, 10000", "0, 1"));
  Teuchos::ParameterList first = tube.resolved();
  first.sublist("Time").set("steps", 2);
  for (const std::string& doubt : judge::sanity_of(first, ideal_tube()).doubts)
    TEST_EQUALITY(doubt.find("a wave runs through"), std::string::npos);
}

TEUCHOS_UNIT_TEST(sanity, meshes_that_do_not_hang_together_or_are_coarse_are_doubted) {
  judge::Vessel vessel = ideal_tube();
  vessel.fluid->pieces = {700, 300};
  vessel.elements_across_lumen = 4;
  vessel.elements_across_wall = 1;
  vessel.wall->least_angle = 1.0;
  const judge::Sanity s = judge::sanity_of(TubeCase().resolved(), vessel);
  TEST_EQUALITY(s.doubts.size(), 4);
  TEST_INEQUALITY(s.doubts[0].find("2 pieces that do not touch, of 700 and 300"),
                  std::string::npos);
}

TEUCHOS_UNIT_TEST(sanity, wall_that_floats_is_doubted) {
  TubeCase tube;
  TEST_ASSERT(!doubts(tube, "no surface holds the wall", out));
  tube.ends = "";
  TEST_ASSERT(doubts(tube, "no surface holds the wall", out));
}

}  // namespace
