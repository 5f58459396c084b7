#include <Teuchos_UnitTestHarness.hpp>
#include <cmath>
#include <limits>

#include "tunica/observe/budget.hpp"
#include "unit/discretisation/few_tets.hpp"

namespace {

using namespace tunica;
using observe::Verdict;

constexpr double step = 0.5, length = 0.6, area = 0.3 * 0.4;
const observe::BudgetSettings usual{true, 1e-6, 0.05};

Teuchos::ParameterList block_list() {
  Teuchos::ParameterList list = test::fluid_list(1.0, 0.05);
  list.set("regions", Teuchos::Array<std::string>(std::vector<std::string>{"block"}));
  list.sublist("Newton").set("relative increment", 1e-12);
  return list;
}

/// The block between walls along which the fluid slides as it does at its ends.
Teuchos::ParameterList closed_list() {
  Teuchos::ParameterList list = block_list();
  for (const char* surface : {"x_low", "x_high", "y_low", "y_high", "z_low", "z_high"})
    test::set_vector(test::condition(list, surface, "velocity"), "velocity", {1.0, 0.0, 0.0});
  return list;
}

/// Driven through by a pressure.
Teuchos::ParameterList open_list() {
  Teuchos::ParameterList list = block_list();
  test::condition(list, "z_low", "no slip");
  test::condition(list, "x_low", "pressure")
      .set("pressure", 0.2)
      .set("backflow stabilisation", 0.0);
  return list;
}

struct Flow {
  explicit Flow(const Teuchos::ParameterList& list)
      : fluid(problems::FluidSettings(test::resolved(list, problems::fluid_table())), few.field),
        budget(usual, &fluid, nullptr, true, true) {}

  /// The row of a step.
  discretisation::Observables make_step(int number) {
    fluid.begin_step(stepping::Clock(step, number));
    is_solved = fluid.solve().is_converged;
    fluid.end_step();
    return budget.add(step, is_solved, fluid.observe());
  }

  test::FewTets few;
  problems::FluidProblem fluid;
  observe::Budget budget;
  bool is_solved = false;
};

Verdict verdict_of(const observe::Budget& budget, const std::string& name) {
  for (const Verdict& one : budget.verdicts())
    if (one.of == name) return one;
  return {name, "", std::nan(""), std::nan(""), std::nan(""), 0.0, false};
}

// u = 1 + g x/L along a block: of what flows through, g/(1 + g/2) is gained.
TEUCHOS_UNIT_TEST(budget, mass_that_prescribed_velocities_gain_is_told) {
  constexpr double gained = 5e-4;
  Flow flow(closed_list());
  flow.fluid.field().set_boundary_velocity([](const Vec3& x, double) {
    return Vec3{1.0 + gained * x[0] / length, 0.0, 0.0};
  });
  flow.make_step(1);
  TEST_ASSERT(flow.is_solved);
  const Verdict mass = verdict_of(flow.budget, "mass");
  TEST_ASSERT(!mass.is_kept());
  TEST_FLOATING_EQUALITY(mass.amount, step * gained * area, 1e-9);
  TEST_FLOATING_EQUALITY(mass.part, gained / (1.0 + 0.5 * gained), 1e-6);
  TEST_INEQUALITY(observe::text_of(mass).find("BEYOND 1e-06"), std::string::npos);
}

TEUCHOS_UNIT_TEST(budget, same_flow_without_gain_keeps_mass) {
  Flow flow(closed_list());
  flow.make_step(1);
  const Verdict mass = verdict_of(flow.budget, "mass");
  TEST_COMPARE(mass.part, <, 1e-14);
  TEST_FLOATING_EQUALITY(mass.whole, step * area, 1e-6);
  TEST_INEQUALITY(observe::text_of(mass).find("within 1e-06"), std::string::npos);
}

// As searches for a steady state end: what flowed in finite steps counts for nothing beside it.
TEUCHOS_UNIT_TEST(budget, an_infinite_step_outweighs_all_before) {
  Flow flow(closed_list());
  flow.make_step(1);
  flow.budget.add(std::numeric_limits<double>::infinity(), true, flow.fluid.observe());
  const Verdict mass = verdict_of(flow.budget, "mass");
  TEST_FLOATING_EQUALITY(mass.whole, area, 1e-6);
  TEST_COMPARE(mass.part, <, 1e-14);
  for (const Verdict& one : flow.budget.verdicts()) TEST_ASSERT(!std::isnan(one.part));
}

// What comes in is what is taken out, stored or left, term by term.
TEUCHOS_UNIT_TEST(budget, energies_of_an_open_flow_add_up) {
  Flow flow(open_list());
  for (int number = 1; number <= 4; ++number) flow.make_step(number);
  TEST_ASSERT(flow.is_solved);
  double sum = 0.0, stored = 0.0, load = 0.0;
  for (const auto& o : flow.budget.energies()) {
    if (o.name == "load_power") load = o.value;
    (o.name == "energy_change" ? stored : sum) += o.value;
  }
  TEST_COMPARE(load, >, 0.0);
  TEST_COMPARE(std::abs(sum - stored), <, 1e-13 * load);
  TEST_FLOATING_EQUALITY(
      stored, test::observed(flow.fluid.observe(), "fluid_kinetic_energy_kPa_mm3"), 1e-12);
  for (const char* of : {"mass", "forces", "energy", "residuals"}) {
    TEST_COMPARE(verdict_of(flow.budget, of).part, <, 1e-9);
    TEST_ASSERT(verdict_of(flow.budget, of).is_of_solver);
  }
  TEST_EQUALITY(verdict_of(flow.budget, "volume").amount, 0.0);
}

TEUCHOS_UNIT_TEST(budget, run_that_goes_on_has_the_same_totals) {
  Flow straight(open_list()), broken(open_list());
  for (int number = 1; number <= 3; ++number) straight.make_step(number);
  for (int number = 1; number <= 2; ++number) broken.make_step(number);
  observe::Budget other(usual, &broken.fluid, nullptr, false, true);
  other.restore(broken.budget.save());
  broken.fluid.begin_step(stepping::Clock(step, 3));
  broken.fluid.solve();
  broken.fluid.end_step();
  other.add(step, true, broken.fluid.observe());
  const auto expected = straight.budget.verdicts(), found = other.verdicts();
  TEST_EQUALITY(found.size(), expected.size());
  for (std::size_t k = 0; k < found.size(); ++k)
    TEST_EQUALITY(observe::text_of(found[k]), observe::text_of(expected[k]));
  for (std::size_t k = 0; k < other.energies().size(); ++k)
    TEST_EQUALITY(other.energies()[k].value, straight.budget.energies()[k].value);
}

// What was stored before its first step is not known: the budget begins behind it.
TEUCHOS_UNIT_TEST(budget, without_a_known_start_the_first_step_counts_for_nothing) {
  Flow flow(open_list());
  observe::Budget other(usual, &flow.fluid, nullptr, false, true);
  flow.make_step(1);
  const auto row = other.add(step, true, flow.fluid.observe());
  TEST_ASSERT(std::isnan(test::observed(row, "energy_change_kPa_mm3_per_ms")));
  TEST_EQUALITY(verdict_of(other, "mass").whole, 0.0);
  flow.make_step(2);
  other.add(step, false, flow.fluid.observe());
  TEST_COMPARE(verdict_of(other, "mass").whole, >, 0.0);
  TEST_ASSERT(!verdict_of(other, "steps").is_kept());
}

}  // namespace
