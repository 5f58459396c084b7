#include <Teuchos_UnitTestHarness.hpp>
#include <cmath>
#include <vector>

#include "tunica/linear/refresh_rule.hpp"

namespace {

using tunica::linear::RefreshRule;

TEUCHOS_UNIT_TEST(refresh_rule, wants_a_new_one_when_as_much_is_lost_as_it_costs) {
  RefreshRule rule(1.0, 20.0);
  TEST_ASSERT(rule.wants_new());
  rule.renew();
  rule.note(8, 1e-8, true);
  TEST_ASSERT(!rule.wants_new());
  rule.note(14, 1e-8, true);  // 6 lost
  rule.note(15, 1e-8, true);  // 13
  TEST_ASSERT(!rule.wants_new());
  rule.note(15, 1e-8, true);  // 20
  TEST_ASSERT(rule.wants_new());
}

TEUCHOS_UNIT_TEST(refresh_rule, a_sharper_tolerance_is_no_loss) {
  RefreshRule rule(1.0, 5.0);
  rule.renew();
  rule.note(3, 1e-3, true);
  for (int solve = 0; solve < 10; ++solve) rule.note(9, 1e-9, true);
  TEST_ASSERT(!rule.wants_new());
}

TEUCHOS_UNIT_TEST(refresh_rule, factors_that_took_one_iteration_are_kept_for_a_few) {
  RefreshRule rule(1.0, 100.0);
  rule.renew();
  rule.note(1, 1e-14, true);
  for (int solve = 0; solve < 24; ++solve) rule.note(5, 1e-8, true);
  TEST_ASSERT(!rule.wants_new());
  rule.note(5, 1e-8, true);
  TEST_ASSERT(rule.wants_new());
}

TEUCHOS_UNIT_TEST(refresh_rule, factor_zero_and_failure_want_a_new_one) {
  RefreshRule always(0.0, 20.0), rule(1.0, 20.0);
  for (RefreshRule* each : {&always, &rule}) {
    each->renew();
    each->note(8, 1e-8, true);
  }
  TEST_ASSERT(always.wants_new());
  rule.note(100, 0.5, false);
  TEST_ASSERT(rule.wants_new());
}

TEUCHOS_UNIT_TEST(refresh_rule, an_old_one_ends_where_a_new_one_would_be_there_before) {
  RefreshRule rule(1.0, 20.0);
  rule.renew();
  rule.note(8, 1e-8, true);  // one iteration a decade: 20 + 7 from the fifth on
  const auto residuals = [](double factor) {
    std::vector<double> all;
    for (int i = 0; i <= 5; ++i) all.push_back(std::pow(factor, i));
    return all;
  };
  TEST_ASSERT(rule.when_to_give_up().gives_up(residuals(0.6), 1e-8));   // 31 to come
  TEST_ASSERT(!rule.when_to_give_up().gives_up(residuals(0.5), 1e-8));  // 22
}

TEUCHOS_UNIT_TEST(refresh_rule, an_old_one_may_take_what_it_took_twice_and_a_set_up) {
  RefreshRule rule(1.0, 20.0);
  rule.renew();
  rule.note(8, 1e-8, true);
  TEST_FLOATING_EQUALITY(rule.cap(1e-4), 2.0 * 4.0 + 20.0 + 10.0, 1e-12);
}

}  // namespace
