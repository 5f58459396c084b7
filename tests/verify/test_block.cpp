// The classic block under compression, κ/μ = 5000, pressed by 4 μ on a quarter of its top to a
// third of its height there (xml/block.xml). A free top stands a pressure, which follows it.

#include <Teuchos_UnitTestHarness.hpp>

#include "field_of.hpp"
#include "tunica/mesh/block.hpp"
#include "tunica/problems/solid_problem.hpp"
#include "tunica/setup/case.hpp"
#include "tunica/setup/schema.hpp"

namespace {

using namespace tunica;

Teuchos::ParameterList wall_list(const std::string& file) {
  setup::CommandLine command;
  command.case_file = TUNICA_CASES "/" + file;
  return setup::read_case(command, setup::solid_table(), *Tpetra::getDefaultComm())
      .list.sublist("Wall");
}

/// xml/block.xml without what holds the top, and with a pressure in the place of the load.
Teuchos::ParameterList free_top() {
  Teuchos::ParameterList list = wall_list("block.xml");
  Teuchos::ParameterList& surfaces = list.sublist("Surfaces");
  surfaces.remove("z_high");
  surfaces.remove("patch");
  Teuchos::ParameterList& load = surfaces.sublist("load");
  load.set("condition", "pressure");
  load.set("pressure", 320.0);
  return list;
}

struct Pressed {
  bool is_full_load = true;
  int most_newton = 0, most_linear = 0;  ///< of a load step
  double sinks = 0.0;                    ///< the centre of the patch [mm]
  double det_F_range = 0.0;
};

double centre_sinks(const problems::SolidProblem& wall) {
  const std::vector<Vec3> d = wall.displacement();
  double mine = -1e300;
  for (int a = 0; a < wall.mesh().n_owned; ++a)
    if (norm(wall.mesh().x[a] - Vec3{0.0, 0.0, 1.0}) < 1e-9) mine = -d[a][2];
  return global_max(*wall.mesh().comm, mine);
}

Pressed press(int n, const Teuchos::ParameterList& list, int steps, Teuchos::FancyOStream& out) {
  const fields::FieldMesh field =
      verify::field_of(mesh::make_block({{1.0, 1.0, 1.0}, {n, n, n}, {n / 2, n / 2}}));
  problems::SolidProblem wall(list, field);
  Pressed result;
  for (stepping::Clock clock(1.0 / steps, steps); !clock.is_done(); clock.advance()) {
    wall.begin_step(clock);
    const nonlinear::NewtonReport report = wall.solve();
    out << n << " cells, load " << clock.time() << ": " << report.steps.size() << " Newton steps, "
        << report.linear_iterations() << " linear iterations " << report.reason << "\n";
    result.is_full_load &= report.is_converged;
    if (!report.is_converged) return result;
    result.most_newton = std::max(result.most_newton, static_cast<int>(report.steps.size()));
    result.most_linear = std::max(result.most_linear, report.linear_iterations());
    wall.end_step();
  }
  result.sinks = centre_sinks(wall);
  for (const auto& o : wall.observe()) {
    if (o.name == "max_det_F") result.det_F_range += o.value;
    if (o.name == "min_det_F") result.det_F_range -= o.value;
  }
  out << n << " cells: sinks by " << result.sinks << ", range of det F " << result.det_F_range
      << "\n";
  return result;
}

void check_convergence(const std::vector<Pressed>& all, Teuchos::FancyOStream& out, bool& success) {
  for (const Pressed& each : all) {
    TEST_ASSERT(each.is_full_load);
    TEST_COMPARE(each.most_newton, <=, 7);
    TEST_COMPARE(each.most_linear, <=, 80);
  }
  for (std::size_t k = 2; k < all.size(); ++k) {
    TEST_COMPARE(all[k].sinks, >, all[k - 1].sinks);
    TEST_COMPARE(
        verify::order(all[k - 1].sinks - all[k - 2].sinks, all[k].sinks - all[k - 1].sinks), >=,
        1.0);
  }
}

TEUCHOS_UNIT_TEST(block, held_top_bears_the_load_and_its_height_converges) {
  std::vector<Pressed> all;
  for (const int n : {4, 8, 16}) all.push_back(press(n, wall_list("block.xml"), 10, out));
  check_convergence(all, out, success);
  // 0.695 is what Richardson extrapolates from 8³, 16³ and 32³ cells, see xml/block/RESULTS.md
  TEST_COMPARE(std::abs(all.back().sinks - 0.695), <, 0.015);
}

TEUCHOS_UNIT_TEST(block, held_top_bears_the_load_in_one_step) {
  const Pressed at_once = press(8, wall_list("block.xml"), 1, out);
  TEST_ASSERT(at_once.is_full_load);
  TEST_FLOATING_EQUALITY(at_once.sinks, press(8, wall_list("block.xml"), 4, out).sinks, 1e-6);
}

TEUCHOS_UNIT_TEST(block, free_top_bears_a_pressure_and_its_height_converges) {
  std::vector<Pressed> all;
  for (const int n : {4, 8, 16}) all.push_back(press(n, free_top(), 10, out));
  check_convergence(all, out, success);
}

TEUCHOS_UNIT_TEST(block, volumetric_subscales_keep_the_volumes_of_elements_and_do_not_lock) {
  Teuchos::ParameterList with = wall_list("block.xml");
  with.set("volumetric stabilisation", 1.0);
  const Pressed without = press(8, wall_list("block.xml"), 5, out);
  const Pressed coarse = press(8, with, 5, out), fine = press(16, with, 5, out);
  TEST_ASSERT(coarse.is_full_load && fine.is_full_load);
  TEST_COMPARE(coarse.det_F_range, <, 0.85 * without.det_F_range);
  // it goes with the mesh
  TEST_COMPARE(std::abs(fine.sinks - 0.695), <, 0.6 * std::abs(coarse.sinks - 0.695));
}

}  // namespace
