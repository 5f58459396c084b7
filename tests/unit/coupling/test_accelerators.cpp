#include <Teuchos_DefaultSerialComm.hpp>
#include <Teuchos_UnitTestHarness.hpp>

#include "tunica/base/error.hpp"
#include "tunica/coupling/registry.hpp"
#include "unit/coupling/interface_vector.hpp"

namespace {

using namespace tunica;
using coupling::InterfaceVector;

Teuchos::ParameterList options(const std::string& accelerator,
                               const std::vector<std::pair<std::string, double>>& numbers = {}) {
  Teuchos::ParameterList list;
  list.set("scheme", std::string("dirichlet-neumann"));
  list.set("accelerator", accelerator);
  for (const auto& [name, value] : numbers) list.set(name, value);
  return list;
}

std::unique_ptr<coupling::Accelerator> make(Teuchos::ParameterList list,
                                            const CommPtr& comm = test::world()) {
  coupling::coupling_table().resolve(list, "Coupling", "");
  return coupling::make_accelerator(list, comm);
}

/// One next() on a global vector.
std::vector<double> next(coupling::Accelerator& accelerator, const std::vector<double>& d,
                         const std::vector<double>& r) {
  const Comm& comm = *test::world();
  return test::whole(accelerator.next(test::share(d, comm), test::share(r, comm)), d.size(), comm);
}

/// A wall's answer d̃ = g + M d with M of the given size, whose fixed point is `solution`; with
/// size > 2 plain iteration explodes.
struct LinearResponse {
  LinearResponse(int n, double size, int seed = 0) : M(n, std::vector<double>(n)), solution(n) {
    for (int i = 0; i < n; ++i) {
      solution[i] = test::scatter(500.0 + i + 31.0 * seed);
      for (int j = 0; j < n; ++j) M[i][j] = size * test::scatter(1.0 + n * i + j) / n;
      M[i][i] -= size;  // added mass: the answer overshoots to the other side
    }
  }
  std::vector<double> residual(const std::vector<double>& d) const {  // (M − I)(d − solution)
    std::vector<double> r(d.size());
    for (std::size_t i = 0; i < d.size(); ++i) {
      r[i] = solution[i] - d[i];
      for (std::size_t j = 0; j < d.size(); ++j) r[i] += M[i][j] * (d[j] - solution[j]);
    }
    return r;
  }
  std::vector<std::vector<double>> M;
  std::vector<double> solution;
};

/// Iterations until the largest residual is below 1e-10; 100 if never.
int iterations(coupling::Accelerator& accelerator, const LinearResponse& response) {
  std::vector<double> d(response.solution.size(), 0.0);
  accelerator.begin_step();
  for (int k = 1; k < 100; ++k) {
    const std::vector<double> r = response.residual(d);
    if (test::largest_difference(r, std::vector<double>(r.size(), 0.0)) < 1e-10) {
      accelerator.end_step();
      return k;
    }
    d = next(accelerator, d, r);
  }
  return 100;
}

/// P r = factor r.
coupling::Accelerator::Preconditioner times(double factor) {
  return [factor](InterfaceVector r) {
    for (double& value : r) value *= factor;
    return r;
  };
}

TEUCHOS_UNIT_TEST(preconditioner, makes_an_exploding_iteration_converge) {
  const LinearResponse response(40, 20.0);
  for (const std::string name : {"constant", "aitken", "iqn-ils"}) {
    const std::string key = name == "constant" ? "factor" : "first factor";
    const auto plain = make(options(name, {{key, 1.0}})), tamed = make(options(name, {{key, 1.0}}));
    tamed->set_preconditioner(times(1.0 / 21.0));
    const int with = iterations(*tamed, response), without = iterations(*plain, response);
    TEST_COMPARE(with, <, 40);
    TEST_COMPARE(with, <, without);
  }
}

TEUCHOS_UNIT_TEST(preconditioner, may_change_under_the_columns_of_earlier_steps) {
  const auto iqn = make(options("iqn-ils", {{"first factor", 0.05}}));
  iterations(*iqn, LinearResponse(5, 5.0));  // every direction is known now
  for (const double factor : {1.0, 0.01, 100.0}) {
    iqn->set_preconditioner(times(factor));
    const int made = iterations(*iqn, LinearResponse(5, 5.0, 3));
    TEST_COMPARE(made, <=, 3);
  }
}

TEUCHOS_UNIT_TEST(inner_product, sums_over_all_ranks) {
  const Comm& comm = *test::world();
  TEST_EQUALITY(coupling::inner_product(comm, test::share({1, 2, 3, 4, 5}, comm),
                                        test::share({1, 1, 1, 1, 2}, comm)),
                20.0);
}

TEUCHOS_UNIT_TEST(constant_relaxation, adds_the_same_part_of_every_residual) {
  const auto relaxation = make(options("constant", {{"factor", 0.25}}));
  for (int k = 0; k < 2; ++k) {
    relaxation->begin_step();
    TEST_ASSERT(next(*relaxation, {1, 2, 3}, {4, 8, -4}) == std::vector<double>({2, 4, 2}));
    TEST_EQUALITY(relaxation->relaxation(), 0.25);
    TEST_EQUALITY(relaxation->columns(), 0);
    relaxation->end_step();
  }
}

TEUCHOS_UNIT_TEST(aitken, two_iterations_match_the_formula_by_hand) {
  const auto aitken = make(options("aitken", {{"first factor", 0.5}}));
  aitken->begin_step();
  TEST_ASSERT(next(*aitken, {0, 0}, {1, 2}) == std::vector<double>({0.5, 1.0}));
  // r₂ − r₁ = (−3, −1): ω = −0.5 (1·−3 + 2·−1)/10 = 0.25
  TEST_ASSERT(next(*aitken, {0.5, 1.0}, {-2, 1}) == std::vector<double>({0.0, 1.25}));
  TEST_EQUALITY(aitken->relaxation(), 0.25);
  // r₃ − r₂ = (2, −2): ω = −0.25 (−2·2 + 1·−2)/8 = 0.1875
  TEST_ASSERT(next(*aitken, {0.0, 1.25}, {0, -1}) == std::vector<double>({0.0, 1.0625}));
  TEST_EQUALITY(aitken->relaxation(), 0.1875);
}

TEUCHOS_UNIT_TEST(aitken, is_exact_in_the_third_iteration_of_a_scalar_problem) {
  const auto aitken = make(options("aitken"));
  const int made = iterations(*aitken, LinearResponse(1, 5.0));
  TEST_EQUALITY(made, 3);
}

TEUCHOS_UNIT_TEST(aitken, converges_where_plain_iteration_explodes) {
  const auto aitken = make(options("aitken"));
  const int made = iterations(*aitken, LinearResponse(12, 5.0));
  TEST_COMPARE(made, <, 60);
}

TEUCHOS_UNIT_TEST(aitken, the_factor_keeps_its_bounds) {
  const auto aitken = make(options(
      "aitken", {{"first factor", 0.5}, {"smallest factor", 0.3}, {"largest factor", 0.6}}));
  aitken->begin_step();
  next(*aitken, {0}, {1});
  next(*aitken, {0.5}, {0.9});  // the formula says 5
  TEST_EQUALITY(aitken->relaxation(), 0.6);
  next(*aitken, {1.04}, {-90});  // the formula says 0.006
  TEST_EQUALITY(aitken->relaxation(), 0.3);
  next(*aitken, {-25.96}, {-90});  // the formula divides by zero
  TEST_EQUALITY(aitken->relaxation(), 0.3);
}

TEUCHOS_UNIT_TEST(aitken, sees_the_update_that_was_made_not_the_one_it_asked_for) {
  const auto aitken = make(options("aitken", {{"first factor", 0.5}}));
  aitken->begin_step();
  TEST_ASSERT(next(*aitken, {0}, {1}) == std::vector<double>({0.5}));
  // r = 1 − 2d at half of the way: the next update is exact.
  TEST_ASSERT(next(*aitken, {0.25}, {0.5}) == std::vector<double>({0.5}));
}

TEUCHOS_UNIT_TEST(aitken, a_step_starts_as_the_case_says) {
  for (const std::string start : {"first factor", "last factor"}) {
    auto list = options("aitken", {{"first factor", 0.5}});
    list.set("first factor of a step", start);
    const auto aitken = make(list);
    aitken->begin_step();
    next(*aitken, {0}, {1});
    next(*aitken, {0.5}, {-1});
    TEST_EQUALITY(aitken->relaxation(), 0.25);
    aitken->end_step();
    aitken->begin_step();
    next(*aitken, {0}, {1});
    TEST_EQUALITY(aitken->relaxation(), start == "first factor" ? 0.5 : 0.25);
  }
}

TEUCHOS_UNIT_TEST(aitken, crossed_bounds_are_refused) {
  TEST_THROW(make(options("aitken", {{"smallest factor", 0.5}, {"largest factor", 0.4}})), Error);
}

TEUCHOS_UNIT_TEST(iqn_ils, solves_a_linear_problem_of_n_unknowns_in_n_plus_one_updates) {
  for (const int n : {1, 2, 5, 9}) {
    const auto iqn = make(options("iqn-ils", {{"first factor", 0.05}}));
    // One relaxation and n least-squares updates; the next iteration sees the end.
    const int made = iterations(*iqn, LinearResponse(n, 5.0));
    TEST_COMPARE(made, <=, n + 2);
  }
}

TEUCHOS_UNIT_TEST(iqn_ils, an_update_does_not_outgrow_the_last_one_of_its_step) {
  // The residual falls by a thousandth over the first update: the model wants 999 times as much.
  for (const auto& [growth, expected] : {std::pair{0.0, 999.0}, std::pair{4.0, 4.0}}) {
    const auto iqn = make(options("iqn-ils", {{"first factor", 0.05}, {"update growth", growth}}));
    iqn->begin_step();
    const double d = next(*iqn, {0}, {1})[0];
    TEST_FLOATING_EQUALITY(d, 0.05, 1e-12);
    TEST_FLOATING_EQUALITY(next(*iqn, {d}, {0.999})[0] - d, expected * d, 1e-9);
    TEST_FLOATING_EQUALITY(iqn->relaxation(), expected / 999.0, 1e-9);
  }
  // What counts is the update that was made: half of the one it asked for.
  const auto iqn = make(options("iqn-ils", {{"first factor", 0.05}, {"update growth", 4.0}}));
  iqn->begin_step();
  next(*iqn, {0}, {1});
  TEST_FLOATING_EQUALITY(next(*iqn, {0.025}, {0.999})[0], 0.025 + 4 * 0.025, 1e-9);
}

TEUCHOS_UNIT_TEST(iqn_ils, starts_with_a_relaxation) {
  const auto iqn = make(options("iqn-ils", {{"first factor", 0.125}}));
  iqn->begin_step();
  TEST_ASSERT(next(*iqn, {1, 1}, {8, -8}) == std::vector<double>({2, 0}));
  TEST_EQUALITY(iqn->relaxation(), 0.125);
  TEST_EQUALITY(iqn->columns(), 0);
}

TEUCHOS_UNIT_TEST(iqn_ils, columns_of_earlier_steps_make_the_next_step_short) {
  const int n = 6;
  auto list = options("iqn-ils");
  list.set("reused steps", 1);
  const auto reuses = make(list);
  list.set("reused steps", 0);
  const auto forgets = make(list);
  const int first = iterations(*reuses, LinearResponse(n, 5.0));
  const int made = iterations(*forgets, LinearResponse(n, 5.0));
  TEST_EQUALITY(made, first);
  const LinearResponse next_step(n, 5.0, 1);  // same M, another solution
  const int with_columns = iterations(*reuses, next_step);
  const int without = iterations(*forgets, next_step);
  TEST_COMPARE(with_columns, <=, 5);
  TEST_COMPARE(with_columns, <, first - 2);
  TEST_COMPARE(without, >=, first - 1);
}

TEUCHOS_UNIT_TEST(iqn_ils, steps_beyond_the_reused_ones_are_forgotten) {
  auto list = options("iqn-ils");
  list.set("reused steps", 2);
  const auto iqn = make(list);
  for (int step = 1; step <= 4; ++step) {  // two iterations each: one column
    iqn->begin_step();
    const double s = step;
    next(*iqn, {0, 0, 0, 0, 0}, {1, 0, 0, 0, s});
    next(*iqn, {0, 0, 0, 0, 0}, {1, s, s * s, s * s * s, s});
    TEST_EQUALITY(iqn->columns(), std::min(step, 3));  // its own and two earlier ones
    iqn->end_step();
  }
}

TEUCHOS_UNIT_TEST(iqn_ils, dependent_columns_are_dropped) {
  const auto iqn = make(options("iqn-ils"));
  iqn->begin_step();
  next(*iqn, {0, 0, 0}, {1, 1, 1});
  next(*iqn, {0, 0, 0}, {2, 1, 1});
  TEST_EQUALITY(iqn->columns(), 1);
  next(*iqn, {0, 0, 0}, {4, 1, 1});  // the same direction again
  TEST_EQUALITY(iqn->columns(), 1);
  next(*iqn, {0, 0, 0}, {4, 2, 1});
  TEST_EQUALITY(iqn->columns(), 2);
}

TEUCHOS_UNIT_TEST(iqn_ils, update_is_independent_of_ranks) {
  const LinearResponse response(11, 5.0);
  const auto many = make(options("iqn-ils")), one = make(options("iqn-ils"), test::alone());
  std::vector<double> d(11, 0.0), e(11, 0.0);
  many->begin_step();
  one->begin_step();
  for (int k = 0; k < 6; ++k) {
    d = next(*many, d, response.residual(d));
    e = one->next(e, response.residual(e));
    TEST_COMPARE(test::largest_difference(d, e), <, 1e-9);
  }
}

/// The state as it returns from a checkpoint: with the rows of this rank.
fields::State state_of(const coupling::Accelerator& accelerator, std::size_t nodes) {
  fields::State state;
  state.places.resize(nodes);
  accelerator.save(state);
  return state;
}

TEUCHOS_UNIT_TEST(accelerators, go_on_after_a_restart_as_if_there_had_been_none) {
  const CommPtr alone = Teuchos::rcp(new Teuchos::SerialComm<int>());
  auto last_factor = options("aitken");
  last_factor.set("first factor of a step", "last factor");
  const std::vector<Teuchos::ParameterList> lists{options("constant"), last_factor,
                                                  options("iqn-ils", {})};
  for (const Teuchos::ParameterList& list : lists) {
    const auto straight = make(list, alone), restarted = make(list, alone);
    const auto step = [&](coupling::Accelerator& accelerator, int number, int rounds) {
      const LinearResponse response(12, 5.0, number);
      InterfaceVector d(12, 0.0);
      accelerator.begin_step();
      for (int k = 0; k < rounds; ++k) d = accelerator.next(d, response.residual(d));
      accelerator.end_step();
      return d;
    };
    for (int number = 0; number < 3; ++number) step(*straight, number, 3 + number);
    restarted->restore(state_of(*straight, 4));
    TEST_ASSERT(step(*straight, 3, 4) == step(*restarted, 3, 4));
  }
}

TEUCHOS_UNIT_TEST(interface_vectors, are_the_same_after_packing) {
  const std::deque<InterfaceVector> vectors{{1, 2, 3, 4, 5, 6}, {7, 8, 9, 10, 11, 12}};
  const fields::State::Array rows = coupling::packed(vectors);
  TEST_EQUALITY(rows.columns, 6);
  TEST_ASSERT(rows.values == std::vector<double>({1, 2, 3, 7, 8, 9, 4, 5, 6, 10, 11, 12}));
  TEST_ASSERT(coupling::unpacked(rows) == vectors);
  TEST_ASSERT(coupling::unpacked(coupling::packed({})).empty());
  const std::deque<InterfaceVector> no_nodes(2);
  TEST_ASSERT(coupling::unpacked(coupling::packed(no_nodes)) == no_nodes);
}

TEUCHOS_UNIT_TEST(iqn_ils, takes_from_a_state_no_more_steps_than_the_case_reuses) {
  const CommPtr alone = Teuchos::rcp(new Teuchos::SerialComm<int>());
  auto few = options("iqn-ils");
  few.set("reused steps", 1);
  const auto many_steps = make(options("iqn-ils"), alone), one_step = make(few, alone);
  const LinearResponse response(12, 5.0);
  for (int number = 0; number < 2; ++number) {
    InterfaceVector d(12, 0.0);
    many_steps->begin_step();
    for (int k = 0; k < 3; ++k) d = many_steps->next(d, response.residual(d));
    many_steps->end_step();
  }
  one_step->restore(state_of(*many_steps, 4));
  TEST_EQUALITY(state_of(*many_steps, 4).arrays["V"].columns, 12);
  TEST_EQUALITY(state_of(*one_step, 4).arrays["V"].columns, 6);
}

}  // namespace
