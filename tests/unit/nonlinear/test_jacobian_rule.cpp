#include <Teuchos_UnitTestHarness.hpp>

#include "tunica/nonlinear/newton.hpp"

namespace {

using namespace tunica;
using nonlinear::JacobianRule;
using nonlinear::NewtonStep;

/// Steps whose increments fall from the first one by these parts.
std::vector<NewtonStep> steps(double first, const std::vector<double>& parts) {
  std::vector<NewtonStep> all(1);
  all.front().increment = first;
  for (const double part : parts) {
    NewtonStep next;
    next.increment = part * all.back().increment;
    all.push_back(next);
  }
  return all;
}

/// Shows the rule one step after the other.
void make(JacobianRule& rule, const std::vector<NewtonStep>& all) {
  std::vector<NewtonStep> so_far;
  for (const NewtonStep& step : all) {
    so_far.push_back(step);
    rule.note(so_far);
  }
}

TEUCHOS_UNIT_TEST(jacobian_rule, without_cost_every_step_has_a_new_one) {
  JacobianRule rule(0.0);
  TEST_ASSERT(rule.wants_new({}, 1e-9));
  rule.renewed();
  make(rule, steps(1e-3, {1e-3}));
  TEST_ASSERT(rule.wants_new(steps(1e-3, {1e-3}), 1e-9));
}

TEUCHOS_UNIT_TEST(jacobian_rule, the_last_one_serves_while_it_takes_no_more_steps_than_a_new_one) {
  // From 1e-5 to 1e-9 are four decades: two steps at 1e-2, four at 1e-1, five and more beyond.
  const double goal = 1.0001e-9;
  const auto renews = [&](double cost, double rate) {
    JacobianRule rule(cost);
    rule.renewed();
    make(rule, steps(1e-3, {1e-2}));  // what a new one does
    rule.note(steps(1e-3, {1e-2}));
    const auto later = steps(1e-5 / rate, {rate});
    rule.note(later);
    return rule.wants_new(later, goal);
  };
  TEST_ASSERT(!renews(2.0, 1e-1));    // 4 against 2 + 2
  TEST_ASSERT(renews(1.0, 1e-1));     // 4 against 1 + 2
  TEST_ASSERT(renews(2.0, 2e-1));     // 6 against 4
  TEST_ASSERT(renews(1000.0, 0.95));  // it hardly falls
}

TEUCHOS_UNIT_TEST(jacobian_rule, an_increment_over_one_of_an_older_jacobian_is_not_the_new_ones) {
  JacobianRule rule(2.0);
  rule.renewed();
  make(rule, steps(1e-3, {0.7}));
  rule.renewed();
  const std::vector<double> parts{0.7, 0.7, 1e-2,
                                  0.6};  // old, from old to new, new, of a later state
  for (std::size_t n = 2; n <= parts.size(); ++n)
    rule.note(steps(1e-3, {parts.begin(), parts.begin() + static_cast<std::ptrdiff_t>(n)}));
  TEST_ASSERT(rule.wants_new(steps(1e-3, parts), 1e-12));
}

TEUCHOS_UNIT_TEST(jacobian_rule, the_next_solve_begins_with_the_last_one_of_the_former) {
  JacobianRule rule(2.0);
  TEST_ASSERT(rule.wants_new({}, 1e-9));  // there is none
  rule.renewed();
  TEST_ASSERT(!rule.wants_new(steps(1e-3, {}), 1e-9));  // nobody knows yet
  make(rule, steps(1e-3, {1e-2, 1e-2, 1e-2}));
  TEST_ASSERT(!rule.wants_new({}, 1e-9));
  rule.forget();
  TEST_ASSERT(rule.wants_new({}, 1e-9));
}

}  // namespace
