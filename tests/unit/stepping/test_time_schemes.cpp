#include <Teuchos_UnitTestHarness.hpp>
#include <cmath>

#include "tunica/stepping/implicit_euler.hpp"
#include "tunica/stepping/registry.hpp"
#include "tunica/stepping/statics.hpp"

namespace {

using namespace tunica;
using stepping::History;
using stepping::ImplicitEuler;

/// A wall's list with a scheme of this name.
Teuchos::ParameterList wall_list(const std::string& scheme, const std::string& analysis) {
  params::Table table;
  stepping::add_scheme_keys(table);
  table.choice("analysis", "dynamic", {"dynamic", "static"}, "");
  Teuchos::ParameterList list;
  list.set("time scheme", scheme).set("analysis", analysis);
  table.resolve(list, "Wall", "");
  return list;
}

/// x(1) of the oscillator ẍ + x = 0 from x(0) = 1 in n steps of a scheme: α x − r + x = 0.
double oscillator(stepping::TimeScheme& scheme, int n) {
  scheme.set_step_size(1.0 / n);
  History history(scheme.remembers(), 1);
  history.value()[0] = {1, 0, 0};
  if (history.names().size() > 1) history[1][0] = {-1, 0, 0};  // the acceleration at the start
  for (int k = 0; k < n; ++k) {
    const double x = scheme.inertia_load(history, 0)[0] / (scheme.inertia(1.0) + 1.0);
    scheme.accept({{x, 0, 0}}, history);
  }
  return history.value()[0][0];
}

TEUCHOS_UNIT_TEST(implicit_euler, rates_by_hand) {
  ImplicitEuler euler(2);
  euler.set_step_size(0.5);
  History history(euler.remembers(), 1);
  history.value()[0] = {1, 0, 0};
  history[0][0] = {4, 0, 0};
  TEST_EQUALITY(euler.rate() * (3.0 - euler.past(history, 0)[0]), 4.0);  // (3 − 1)/½
  // (ẋ − 4)/½ with ẋ = (3 − 1)/½ is nothing; with 4 in the place of 3 it is (6 − 4)/½
  TEST_EQUALITY(euler.inertia(1.0) * 3.0 - euler.inertia_load(history, 0)[0], 0.0);
  TEST_EQUALITY(euler.inertia(2.0) * 4.0 - 2.0 * euler.inertia_load(history, 0)[0], 8.0);
  euler.accept({{4, 0, 0}}, history);
  TEST_EQUALITY(history.value()[0][0], 4.0);
  TEST_EQUALITY(history[0][0][0], 6.0);
}

TEUCHOS_UNIT_TEST(implicit_euler, remembers_a_velocity_only_where_inertia_is_asked_for) {
  TEST_ASSERT(ImplicitEuler(1).remembers().empty());
  TEST_EQUALITY(ImplicitEuler(2).remembers().size(), 1);
}

TEUCHOS_UNIT_TEST(time_scheme, every_one_of_the_registry_converges_on_an_oscillator) {
  for (const stepping::SchemeEntry& entry : stepping::schemes()) {
    const auto scheme = stepping::make_scheme(wall_list(entry.name, "dynamic"));
    const double coarse = std::abs(oscillator(*scheme, 200) - std::cos(1.0));
    const double fine = std::abs(oscillator(*scheme, 400) - std::cos(1.0));
    out << entry.name << ": " << coarse << " " << fine << "\n";
    TEST_COMPARE(fine, <, 0.01);
    TEST_COMPARE(std::log2(coarse / fine), >, 0.95);  // the order, at least one
  }
}

TEUCHOS_UNIT_TEST(time_scheme, in_statics_nothing_has_inertia) {
  const auto scheme = stepping::make_scheme(wall_list("newmark", "static"));
  scheme->set_step_size(0.1);
  History history(scheme->remembers(), 1);
  scheme->accept({{1, 2, 3}}, history);
  TEST_EQUALITY(scheme->inertia(7.0), 0.0);
  TEST_EQUALITY(norm(scheme->inertia_load(history, 0)), 0.0);
  TEST_EQUALITY(norm(history[0][0]), 0.0);
  TEST_EQUALITY(history.value()[0][1], 2.0);
}

}  // namespace
