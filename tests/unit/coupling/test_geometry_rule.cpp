#include <Teuchos_UnitTestHarness.hpp>
#include <string>

#include "tunica/coupling/geometry_rule.hpp"

namespace {

using namespace tunica;
using coupling::GeometryRule;

nonlinear::NewtonReport report(int newton, int krylov) {
  nonlinear::NewtonReport made;
  made.is_converged = true;
  made.steps.resize(newton);
  made.steps.front().linear.iterations = krylov;
  return made;
}

/// Newton and Krylov iterations of a step, without shape derivatives and with them.
struct Counts {
  int newton[2], krylov[2];
};
constexpr Counts on_a_tube{{6, 6}, {8, 10}};
constexpr Counts in_a_bend{{15, 5}, {75, 30}};

/// So many steps: '+' where they had shape derivatives, '-' where not.
std::string march(GeometryRule& rule, const Counts& counts, int steps) {
  std::string ways;
  for (int k = 0; k < steps; ++k) {
    const int way = rule.wants_derivatives() ? 1 : 0;
    ways += "-+"[way];
    rule.note(report(counts.newton[way], counts.krylov[way]),
              way == 0 && counts.newton[way] > GeometryRule::most_without);
  }
  return ways;
}

TEUCHOS_UNIT_TEST(geometry_rule, derivatives_are_tried_ever_less_often_where_they_cost) {
  GeometryRule rule;
  const std::string ways = march(rule, on_a_tube, 16);
  TEST_EQUALITY(ways, "----++--------++");
  march(rule, on_a_tube, 16 + 2 + 32 + 2 + 64 + 2);
  const std::string later = march(rule, on_a_tube, 66);
  TEST_EQUALITY(later, std::string(64, '-') + "++");  // no less often than this
}

TEUCHOS_UNIT_TEST(geometry_rule, derivatives_come_at_once_and_stay_where_they_pay) {
  GeometryRule rule;
  const std::string ways = march(rule, in_a_bend, 20);
  TEST_EQUALITY(ways, "-++++++-++++++++++++");  // a trial without them ends with its first step
}

TEUCHOS_UNIT_TEST(geometry_rule, one_hard_step_leads_to_a_trial_of_derivatives) {
  GeometryRule rule;
  march(rule, on_a_tube, 10);
  march(rule, {{12, 8}, {14, 10}}, 1);
  const std::string ways = march(rule, on_a_tube, 12);
  // two of the trial, which looks won beside the hard step, four on that way, and back for good
  TEST_EQUALITY(ways, "++++++------");
}

TEUCHOS_UNIT_TEST(geometry_rule, follows_a_flow_that_changes) {
  GeometryRule rule;
  march(rule, in_a_bend, 20);
  march(rule, on_a_tube, 40);
  TEST_ASSERT(!rule.wants_derivatives());
}

TEUCHOS_UNIT_TEST(geometry_rule, a_failure_without_derivatives_calls_for_them) {
  GeometryRule rule;
  march(rule, on_a_tube, 1);
  rule.note_failure();
  const std::string ways = march(rule, in_a_bend, 33);
  TEST_EQUALITY(ways, std::string(32, '+') + "-");
  rule.note_failure();
  const std::string later = march(rule, in_a_bend, 64);
  TEST_EQUALITY(later, std::string(64, '+'));
}

TEUCHOS_UNIT_TEST(geometry_rule, goes_on_from_its_state) {
  GeometryRule rule, other;
  march(rule, on_a_tube, 11);
  fields::State state;
  rule.save(state);
  other.restore(state);
  for (int k = 0; k < 30; ++k) {
    TEST_EQUALITY(rule.wants_derivatives(), other.wants_derivatives());
    march(rule, in_a_bend, 1);
    march(other, in_a_bend, 1);
  }
}

}  // namespace
