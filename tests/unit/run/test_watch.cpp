#include <Teuchos_UnitTestHarness.hpp>

#include "tunica/run/watch.hpp"
#include "unit/fields/small_tube.hpp"
#include "unit/judge/sanity_cases.hpp"

namespace {

using namespace tunica;
using test::condition;
using test::number;
using test::TubeCase;

run::StepSummary after(int coupling_iterations) {
  run::StepSummary step;
  step.is_converged = step.is_accepted = true;
  step.coupling_iterations = coupling_iterations;
  step.fields = {{"system", coupling_iterations, 10}};
  return step;
}

/// Layers of which one has lost volume, or none.
judge::LayerVolume lost() {
  return {"media", 40, 3, 0, 0.8, 1.05, 0.85, 1.04, 0.88, 1.02, {1.0, 2.0, 3.0}};
}
judge::LayerVolume spread() {
  return {"adventitia", 40, 3, 2, 0.7, 1.3, 0.85, 1.2, 0.98, 1.02, {1.0, 2.0, 3.0}};
}
std::vector<judge::LayerVolume> some_lost() { return {lost()}; }

/// How many lines each of the steps gives.
std::vector<int> counts(run::Watch& watch, const std::vector<discretisation::Observables>& steps) {
  std::vector<int> found;
  for (const auto& observables : steps)
    found.push_back(
        static_cast<int>(watch.look(after(1), 1.0, observables, nullptr, {}, some_lost).size()));
  return found;
}

using Counts = std::vector<int>;

discretisation::Observables volumes(double low, double high) {
  return {{"min_det_F", low}, {"max_det_F", high}};
}

TEUCHOS_UNIT_TEST(watch, wall_that_loses_volume_is_told_once) {
  run::Watch watch(TubeCase().resolved());
  const Counts found = counts(watch, {volumes(0.95, 1.05), volumes(0.8, 1.05), volumes(0.7, 1.05)});
  TEST_COMPARE_ARRAYS(found, (Counts{0, 1, 0}));
}

// Linear elements trade their volumes about a node: that is no loss.
TEUCHOS_UNIT_TEST(watch, spread_of_elements_is_no_warning_and_hides_none) {
  run::Watch watch(TubeCase().resolved());
  std::vector<judge::LayerVolume> layers{spread()};
  const auto look = [&] {
    return watch.look(after(1), 1.0, volumes(0.7, 1.3), nullptr, {}, [&] { return layers; });
  };
  const auto noted = look();
  TEST_EQUALITY(noted.size(), 1);
  TEST_EQUALITY(noted.at(0).find("warning"), std::string::npos);
  TEST_INEQUALITY(noted.at(0).find("no volume is lost"), std::string::npos);
  TEST_INEQUALITY(noted.at(0).find("3 are beyond 0.9 to 1.1, 2 of them at sharp edges"),
                  std::string::npos);
  TEST_EQUALITY(look().size(), 0);
  layers.push_back(lost());
  const auto warned = look();
  TEST_EQUALITY(warned.size(), 1);
  TEST_INEQUALITY(
      warned.at(0).find("warning: \"media\": 98 % of its 40 elements have 0.85 to 1.04"),
      std::string::npos);
  TEST_INEQUALITY(warned.at(0).find("the worst at (1, 2, 3)"), std::string::npos);
}

TEUCHOS_UNIT_TEST(watch, volume_of_a_layer_is_that_of_its_elements_and_about_its_nodes) {
  const test::SmallTube tube;
  const fields::FieldMesh& wall = tube.wall;
  // J = 1 + 0.15 (1 − z/L), in three layers of elements by their middles: 1.125, 1.075, 1.025.
  double L = 0.0;
  for (const Vec3& x : wall.x) L = std::max(L, x[2]);
  L = global_max(*wall.comm, L);
  std::vector<Vec3> D;
  for (const Vec3& x : wall.x) D.push_back({0.0, 0.0, 0.15 * x[2] * (1.0 - 0.5 * x[2] / L)});
  const auto volume = [&](const std::vector<Vec3>& X, const std::vector<Vec3>& d) {
    return judge::layer_volume(wall, 1, assembly::ElementGeometry(wall, X), d,
                               std::vector<char>(wall.n_nodes(), 0));
  };
  const judge::LayerVolume change = volume(wall.x, D);
  TEST_EQUALITY(change.layer, wall.regions[1]);
  TEST_EQUALITY(3 * change.beyond, change.elements);
  TEST_COMPARE(change.place[2], <, L / 3.0);
  TEST_FLOATING_EQUALITY(change.largest, 1.125, 1e-12);
  TEST_FLOATING_EQUALITY(change.low, 1.025, 1e-3);
  TEST_FLOATING_EQUALITY(change.high, 1.125, 1e-3);
  TEST_FLOATING_EQUALITY(change.most_mean, 1.125, 1e-12);  // at the end, where there is one alone
  TEST_ASSERT(judge::loses_volume(change));
  // The image of a wall that is longer without stress, x = 0.905 X: J is that of X.
  std::vector<Vec3> X(wall.x), from_X;
  for (Vec3& x : X) x[2] /= 0.905;
  for (std::size_t a = 0; a < X.size(); ++a) from_X.push_back(wall.x[a] - X[a]);
  TEST_EQUALITY(volume(X, from_X).beyond, 0);
}

TEUCHOS_UNIT_TEST(watch, edges_of_a_tube_are_those_of_its_ends) {
  const test::SmallTube tube;
  double L = 0.0;
  for (const Vec3& x : tube.wall.x) L = std::max(L, x[2]);
  L = global_max(*tube.wall.comm, L);
  const std::vector<char> is_at_edge = judge::nodes_at_edges(tube.wall);
  const std::vector<int> sides{tube.surface("interface"), tube.surface("outer")};
  for (int a = 0; a < tube.wall.n_owned; ++a) {
    const double z = tube.wall.x[a][2];
    const bool is_at_end = z < 1e-9 || z > L - 1e-9;
    TEST_EQUALITY(is_at_edge[a] != 0, is_at_end && tube.wall.is_on_any(a, sides));
  }
}

TEUCHOS_UNIT_TEST(watch, compressible_wall_may_lose_volume) {
  TubeCase tube;
  tube.c10 = "1e9";  // of the size of the bulk modulus
  run::Watch watch(tube.resolved());
  TEST_EQUALITY(watch.look(after(1), 1.0, volumes(0.5, 1.5), nullptr, {}, some_lost).size(), 0);
}

// As a plaque beside a media: what counts is the element's own bulk modulus.
TEUCHOS_UNIT_TEST(watch, a_stiff_layer_mutes_none_that_is_nearly_incompressible) {
  for (const std::string stiff : {"media", "adventitia"}) {
    Teuchos::ParameterList list = TubeCase().resolved();
    list.sublist("Wall").sublist("Layers").sublist(stiff).set("c10", 1e9);
    const test::SmallTube tube;
    problems::SolidProblem wall(list.sublist("Wall"), tube.wall);
    fields::State state = wall.save();  // all of it has 1.2 of its volume
    for (int a = 0; a < tube.wall.n_owned; ++a)
      state.arrays["displacement"].values[3 * a + 2] = 0.2 * tube.wall.x[a][2];
    wall.restore(state);
    wall.begin_step(stepping::Clock(1.0, 1));
    const std::vector<judge::LayerVolume> layers = judge::layer_volumes(wall);
    TEST_EQUALITY(layers.size(), 1);  // the other one
    TEST_INEQUALITY(layers.at(0).layer, stiff);
    TEST_EQUALITY(layers.at(0).beyond, layers.at(0).elements);
    TEST_FLOATING_EQUALITY(layers.at(0).largest, 1.2, 1e-12);
    TEST_FLOATING_EQUALITY(layers.at(0).least_mean, 1.0, 1e-12);
    TEST_FLOATING_EQUALITY(layers.at(0).most_mean, 1.2, 1e-12);
    run::Watch watch(list);
    const Counts found = counts(watch, {volumes(0.8, 1.2)});
    TEST_COMPARE_ARRAYS(found, (Counts{1}));
    run::Watch other(list);  // only the stiff layer loses any
    const auto kept = [] { return std::vector{judge::LayerVolume{"media", 40}}; };
    TEST_EQUALITY(other.look(after(1), 1.0, volumes(0.8, 1.2), nullptr, {}, kept).size(), 0);
  }
}

TEUCHOS_UNIT_TEST(watch, backflow_counts_where_nothing_takes_it_out) {
  const auto flow = [](double value) {
    return discretisation::Observables{{"inflow_inlet_mm3_per_ms", 2.0},
                                       {"inflow_outlet_mm3_per_ms", value}};
  };
  TubeCase tube;
  run::Watch bare(tube.resolved());
  // An inlet so far; an outlet; hardly anything; too much; once only.
  const Counts found = counts(bare, {flow(1.0), flow(-2.0), flow(0.1), flow(0.5), flow(0.6)});
  TEST_COMPARE_ARRAYS(found, (Counts{0, 0, 0, 1, 0}));
  tube.outlet = condition("outlet", "pressure",
                          number("pressure", "0") + number("backflow stabilisation", "0.2"));
  run::Watch guarded(tube.resolved());
  const Counts none = counts(guarded, {flow(-2.0), flow(1.0)});
  TEST_COMPARE_ARRAYS(none, (Counts{0, 0}));
}

TEUCHOS_UNIT_TEST(watch, iterations_near_their_cap_are_told) {
  const Teuchos::ParameterList list = TubeCase().resolved();
  const int most = list.sublist("Coupling").sublist("Newton").get<int>("max iterations");
  run::Watch watch(list);
  const auto few = watch.look(after(most / 2), 1.0, {}), many = watch.look(after(most), 1.0, {});
  TEST_EQUALITY(few.size(), 0);
  TEST_EQUALITY(many.size(), 1);
}

TEUCHOS_UNIT_TEST(watch, deformation_is_that_of_a_stretch_on_any_number_of_ranks) {
  const test::SmallTube tube;
  const auto stretched = [&](double factor) {
    std::vector<Vec3> d;
    for (const Vec3& x : tube.fluid.x) d.push_back({0.0, 0.0, (factor - 1.0) * x[2]});
    return run::worst_deformation(tube.fluid, d);
  };
  const run::Deformation none = stretched(1.0), flat = stretched(0.05);
  TEST_FLOATING_EQUALITY(none.part_of_quality, 1.0, 1e-12);
  TEST_FLOATING_EQUALITY(none.part_of_volume, 1.0, 1e-12);
  TEST_FLOATING_EQUALITY(flat.part_of_volume, 0.05, 1e-10);
  TEST_COMPARE(flat.part_of_quality, <, 0.3);
  TEST_FLOATING_EQUALITY(stretched(-1.0).part_of_volume, -1.0, 1e-10);
  TEST_EQUALITY(stretched(-1.0).quality, 0.0);

  run::Watch watch(TubeCase().resolved());
  std::vector<Vec3> d(tube.fluid.x.size());
  Counts found;
  for (const double part : {0.0, 0.95, 0.96}) {
    for (std::size_t a = 0; a < d.size(); ++a) d[a] = {0.0, 0.0, -part * tube.fluid.x[a][2]};
    found.push_back(static_cast<int>(watch.look(after(1), 1.0, {}, &tube.fluid, d).size()));
  }
  TEST_COMPARE_ARRAYS(found, (Counts{0, 1, 0}));
}

TEUCHOS_UNIT_TEST(watch, advises_no_mesh_motion_that_is_set) {
  const test::SmallTube tube;
  std::vector<Vec3> d;
  for (const Vec3& x : tube.fluid.x) d.push_back({0.0, 0.0, -0.95 * x[2]});
  for (const std::string law : {"harmonic", "elastic"})
    for (const double stiffening : {0.0, 1.0}) {
      Teuchos::ParameterList list = TubeCase().resolved();
      list.sublist("Mesh Motion").set("law", law).set("stiffening", stiffening);
      if (law == "elastic") list.sublist("Mesh Motion").set("poisson ratio", 0.3);
      const auto lines = run::Watch(list).look(after(1), 1.0, {}, &tube.fluid, d);
      TEST_EQUALITY(lines.size(), 1);
      const auto has = [&](const char* text) { return lines[0].find(text) != std::string::npos; };
      TEST_EQUALITY(has("law = elastic"), law == "harmonic");
      TEST_EQUALITY(has("stiffening = 1"), stiffening == 0.0);
      TEST_ASSERT(has("larger elements"));
    }
}

}  // namespace
