#include <Teuchos_UnitTestHarness.hpp>
#include <cmath>

#include "tunica/stepping/bdf2.hpp"
#include "tunica/stepping/implicit_euler.hpp"
#include "tunica/stepping/newmark.hpp"
#include "tunica/stepping/registry.hpp"
#include "tunica/stepping/statics.hpp"
#include "tunica/stepping/trapezoidal.hpp"

namespace {

using namespace tunica;
using stepping::ImplicitEuler;
using stepping::Timeline;

/// Of so many numbers, zero at the start.
Timeline remembered_by(const stepping::TimeScheme& scheme, int width = 1) {
  return {fields::Places::everywhere(), width, scheme.remembers()};
}

/// A wall's list with a scheme of this name.
Teuchos::ParameterList wall_list(const std::string& scheme, const std::string& analysis) {
  params::Table table;
  stepping::add_wall_scheme_keys(table);
  table.choice("analysis", "dynamic", {"dynamic", "static"}, "");
  Teuchos::ParameterList list;
  list.set("time scheme", scheme).set("analysis", analysis);
  table.resolve(list, "Wall", "");
  return list;
}

/// x(1) of ẍ + x = f(t) from rest in n steps of a scheme.
template <class Load>
double oscillator_from_rest(stepping::TimeScheme& scheme, int n, const Load& f) {
  Timeline history = remembered_by(scheme);
  for (stepping::Clock clock(1.0 / n, n); !clock.is_done(); clock.advance()) {
    scheme.begin_step(clock);
    const double load = f(clock.time()) + scheme.inertia_load(history, 0);
    scheme.accept({load / (scheme.inertia(1.0) + 1.0)}, history);
  }
  return history.value()[0];
}

double smooth_load(double t) { return std::pow(std::sin(std::acos(-1.0) * t), 2); }
double sudden_load(double) { return 1.0; }

/// x(1) of ẋ + x = f(t) from rest in n steps of a scheme.
template <class Load>
double decay_from_rest(stepping::TimeScheme& scheme, int n, const Load& f) {
  Timeline history = remembered_by(scheme);
  for (stepping::Clock clock(1.0 / n, n); !clock.is_done(); clock.advance()) {
    scheme.begin_step(clock);
    const double load = f(clock.time()) + scheme.rate() * scheme.past(history, 0);
    scheme.accept({load / (scheme.rate() + 1.0)}, history);
  }
  return history.value()[0];
}

/// x(1) of the oscillator ẍ + x = 0 from x(0) = 1 in n steps of a scheme: α x − r + x = 0.
double oscillator(stepping::TimeScheme& scheme, int n) {
  Timeline history = remembered_by(scheme);
  history.value()[0] = 1;
  for (std::size_t k = 0; k < history.names().size(); ++k)
    if (history.names()[k] == "acceleration") history[static_cast<int>(k)][0] = -1;
  for (stepping::Clock clock(1.0 / n, n); !clock.is_done(); clock.advance()) {
    scheme.begin_step(clock);
    const double x = scheme.inertia_load(history, 0) / (scheme.inertia(1.0) + 1.0);
    scheme.accept({x}, history);
  }
  return history.value()[0];
}

TEUCHOS_UNIT_TEST(implicit_euler, rates_by_hand) {
  ImplicitEuler euler(2);
  euler.set_step_size(0.5);
  Timeline history = remembered_by(euler);
  history.value()[0] = 1;
  history[0][0] = 4;
  TEST_EQUALITY(euler.rate() * (3.0 - euler.past(history, 0)), 4.0);  // (3 − 1)/½
  // (ẋ − 4)/½ with ẋ = (3 − 1)/½ is nothing; with 4 in the place of 3 it is (6 − 4)/½
  TEST_EQUALITY(euler.inertia(1.0) * 3.0 - euler.inertia_load(history, 0), 0.0);
  TEST_EQUALITY(euler.inertia(2.0) * 4.0 - 2.0 * euler.inertia_load(history, 0), 8.0);
  euler.accept({4}, history);
  TEST_EQUALITY(history.value()[0], 4.0);
  TEST_EQUALITY(history[0][0], 6.0);
}

TEUCHOS_UNIT_TEST(implicit_euler, remembers_a_velocity_only_where_inertia_is_asked_for) {
  TEST_ASSERT(ImplicitEuler(1).remembers().empty());
  TEST_EQUALITY(ImplicitEuler(2).remembers().size(), 1);
}

TEUCHOS_UNIT_TEST(time_scheme, every_one_of_the_registry_converges_on_an_oscillator) {
  for (const stepping::SchemeEntry& entry : stepping::schemes()) {
    const auto scheme = stepping::make_wall_scheme(wall_list(entry.name, "dynamic"));
    const double coarse = std::abs(oscillator(*scheme, 200) - std::cos(1.0));
    const double fine = std::abs(oscillator(*scheme, 400) - std::cos(1.0));
    out << entry.name << ": " << coarse << " " << fine << "\n";
    TEST_COMPARE(fine, <, 0.01);
    TEST_COMPARE(std::log2(coarse / fine), >, 0.95);  // the order, at least one
  }
}

TEUCHOS_UNIT_TEST(time_scheme, predictions_are_of_its_order) {
  // x = 1 + 2t seen at 0.1 and 0.6, expected at 0.9
  const auto x = [](double t) { return 1.0 + 2.0 * t; };
  for (const stepping::SchemeEntry& entry : stepping::schemes()) {
    const auto scheme = stepping::make_wall_scheme(wall_list(entry.name, "dynamic"));
    Timeline history = remembered_by(*scheme);
    history.value()[0] = x(0.6);
    for (std::size_t k = 0; k < history.names().size(); ++k) {
      if (history.names()[k] == "velocity") history[static_cast<int>(k)][0] = 2;
      if (history.names()[k] == "previous") history[static_cast<int>(k)][0] = x(0.1);
    }
    scheme->set_step_size(0.3, 0.5);
    const double expected = entry.name == "implicit euler" ? x(0.6) : x(0.9);
    TEST_FLOATING_EQUALITY(scheme->predictions(history)[0], expected, 1e-14);
    scheme->set_step_size(0.3);  // of a first step only the start is known, and its rate
    if (entry.name == "bdf2") TEST_EQUALITY(scheme->predictions(history)[0], x(0.6));
  }
}

TEUCHOS_UNIT_TEST(bdf2, is_exact_for_parabolas_at_any_steps) {
  // x = 3 + 2t − t² and its rates, from two exact values at uneven steps
  const auto x = [](double t) { return 3.0 + 2.0 * t - t * t; };
  const auto v = [](double t) { return 2.0 - 2.0 * t; };
  for (const double dt : {0.2, 0.5, 0.7}) {
    stepping::Bdf2 first(1), second(2);
    Timeline one = remembered_by(first), two = remembered_by(second);
    const double before = 0.1, last = 0.6, now = last + dt;
    one.value()[0] = two.value()[0] = x(last);
    one[0][0] = two[1][0] = x(before);
    two[0][0] = v(last);
    two[2][0] = v(before);
    for (stepping::TimeScheme* scheme : {static_cast<stepping::TimeScheme*>(&first),
                                         static_cast<stepping::TimeScheme*>(&second)}) {
      scheme->set_step_size(dt, last - before);
      const Timeline& history = scheme == &first ? one : two;
      TEST_FLOATING_EQUALITY(scheme->rate() * (x(now) - scheme->past(history, 0)), v(now), 1e-13);
    }
    // ẍ = −2: the rate of the rate
    TEST_FLOATING_EQUALITY(second.inertia(5.0) * x(now) - 5.0 * second.inertia_load(two, 0), -10.0,
                           1e-12);
    second.accept({x(now)}, two);
    TEST_FLOATING_EQUALITY(two[0][0], v(now), 1e-13);
    TEST_EQUALITY(two[1][0], x(last));
    TEST_EQUALITY(two[2][0], v(last));
  }
}

TEUCHOS_UNIT_TEST(bdf2, begins_with_a_step_of_implicit_euler) {
  stepping::Bdf2 bdf2(2);
  ImplicitEuler euler(2);
  Timeline ours = remembered_by(bdf2, 3), theirs = remembered_by(euler, 3);
  for (auto* history : {&ours, &theirs}) {
    history->value() = {1, 2, 3};
    (*history)[0] = {4, 5, 6};
  }
  bdf2.begin_step(stepping::Clock(0.25, 4));
  euler.begin_step(stepping::Clock(0.25, 4));
  TEST_EQUALITY(bdf2.rate(), euler.rate());
  TEST_ASSERT(bdf2.pasts(ours) == euler.pasts(theirs));
  TEST_ASSERT(bdf2.inertia_loads(ours) == euler.inertia_loads(theirs));
  stepping::Clock later(0.25, 4);
  later.advance();
  bdf2.begin_step(later);
  TEST_FLOATING_EQUALITY(bdf2.rate(), 1.5 / 0.25, 1e-14);
}

TEUCHOS_UNIT_TEST(bdf2, is_of_second_order_on_an_oscillator) {
  stepping::Bdf2 bdf2(2);
  // x = (1 − cos t)/2 + (cos 2πt − cos t)/(8π² − 2)
  const double pi = std::acos(-1.0);
  const double exact = 0.5 * (1.0 - std::cos(1.0)) * (1.0 + 1.0 / (4.0 * pi * pi - 1.0));
  const double coarse = oscillator_from_rest(bdf2, 400, smooth_load) - exact;
  const double fine = oscillator_from_rest(bdf2, 800, smooth_load) - exact;
  TEST_FLOATING_EQUALITY(std::log2(coarse / fine), 2.0, 0.02);
  TEST_COMPARE(std::abs(fine), <, 1e-6);
}

TEUCHOS_UNIT_TEST(newmark, is_of_second_order_under_a_sudden_load_with_eulers_start) {
  const double exact = 1.0 - std::cos(1.0);
  const auto order = [&](stepping::Newmark newmark) {
    const double coarse = oscillator_from_rest(newmark, 200, sudden_load) - exact;
    const double fine = oscillator_from_rest(newmark, 400, sudden_load) - exact;
    return std::log2(coarse / fine);
  };
  using stepping::Newmark;
  TEST_FLOATING_EQUALITY(order(Newmark(0.25, 0.5, Newmark::Start::implicit_euler)), 2.0, 0.05);
  TEST_FLOATING_EQUALITY(order(Newmark(0.25, 0.5)), 1.0, 0.05);  // aⁿ⁻¹ = 0 is not that of the load
}

TEUCHOS_UNIT_TEST(newmark, eulers_start_is_a_step_of_implicit_euler) {
  stepping::Newmark newmark(0.3, 0.6, stepping::Newmark::Start::implicit_euler);
  ImplicitEuler euler(2);
  Timeline ours = remembered_by(newmark, 3), theirs = remembered_by(euler, 3);
  for (auto* history : {&ours, &theirs}) {
    history->value() = {1, 2, 3};
    (*history)[0] = {4, 5, 6};
  }
  ours[1] = {7, 8, 9};  // of before a kink of the load
  for (stepping::TimeScheme* scheme :
       {static_cast<stepping::TimeScheme*>(&newmark), static_cast<stepping::TimeScheme*>(&euler)})
    scheme->set_step_size(0.25);
  TEST_EQUALITY(newmark.rate(), euler.rate());
  TEST_COMPARE_FLOATING_ARRAYS(newmark.pasts(ours), euler.pasts(theirs), 1e-14);
  TEST_COMPARE_FLOATING_ARRAYS(newmark.inertia_loads(ours), euler.inertia_loads(theirs), 1e-13);
  const stepping::Rows x{2, 1, 5}, v_before = theirs[0];
  newmark.accept(x, ours);
  euler.accept(x, theirs);
  TEST_COMPARE_FLOATING_ARRAYS(ours[0], theirs[0], 1e-13);
  for (int i = 0; i < 3; ++i)  // a = (v − vⁿ⁻¹)/Δt
    TEST_FLOATING_EQUALITY(ours[1][i], 4.0 * (theirs[0][i] - v_before[i]), 1e-12);
}

TEUCHOS_UNIT_TEST(trapezoidal, is_of_second_order_and_begins_anew_with_euler) {
  const double pi = std::acos(-1.0), e = std::exp(-1.0);
  // of ẋ + x = ½ (1 − cos 2πt):  x = ½ (1 − e⁻ᵗ) − (cos 2πt + 2π sin 2πt − e⁻ᵗ)/(2 (1 + 4π²))
  const double smooth = 0.5 * (1.0 - e) * (1.0 - 1.0 / (1.0 + 4.0 * pi * pi));
  stepping::Trapezoidal scheme;
  for (const bool is_smooth : {true, false}) {
    const auto error = [&](int n) {
      return is_smooth ? decay_from_rest(scheme, n, smooth_load) - smooth
                       : decay_from_rest(scheme, n, sudden_load) - (1.0 - e);
    };
    TEST_FLOATING_EQUALITY(std::log2(error(400) / error(800)), 2.0, 0.03);
    TEST_COMPARE(std::abs(error(800)), <, 2e-6);
  }
}

TEUCHOS_UNIT_TEST(trapezoidal, fluid_and_wall_make_the_same_velocity_of_a_displacement) {
  // what the mesh on the interface does with the fluid's scheme, the wall does with its own
  const auto wall = stepping::make_wall_scheme(wall_list("trapezoidal", "dynamic"));
  stepping::Trapezoidal mesh;
  Timeline of_wall = remembered_by(*wall), of_mesh = remembered_by(mesh);
  double x = 0.0, previous = 0.0;
  for (const double dt : {0.25, 0.25, 0.1, 0.4}) {
    for (stepping::TimeScheme* scheme : {wall.get(), static_cast<stepping::TimeScheme*>(&mesh)})
      scheme->set_step_size(dt, previous);
    x += dt * dt;
    TEST_FLOATING_EQUALITY(mesh.rate() * (x - mesh.past(of_mesh, 0)),
                           wall->rate() * (x - wall->past(of_wall, 0)), 1e-12);
    wall->accept({x}, of_wall);
    mesh.accept({x}, of_mesh);
    TEST_FLOATING_EQUALITY(of_mesh[0][0], of_wall[0][0], 1e-12);
    previous = dt;
  }
}

TEUCHOS_UNIT_TEST(trapezoidal, keeps_the_energy_of_an_oscillator) {
  const auto scheme = stepping::make_wall_scheme(wall_list("trapezoidal", "dynamic"));
  Timeline history = remembered_by(*scheme);
  history.value()[0] = 1;
  const auto energy = [&history] {
    return 0.5 * (history.value()[0] * history.value()[0] + history[0][0] * history[0][0]);
  };
  double first = 0.0;
  for (stepping::Clock clock(0.3, 200); !clock.is_done(); clock.advance()) {
    scheme->begin_step(clock);
    const double x = scheme->inertia_load(history, 0) / (scheme->inertia(1.0) + 1.0);
    scheme->accept({x}, history);
    if (clock.step() == 1) first = energy();  // behind Euler's step
    TEST_FLOATING_EQUALITY(energy(), first, 1e-12);
  }
}

TEUCHOS_UNIT_TEST(time_scheme, in_statics_nothing_has_inertia) {
  const auto scheme = stepping::make_wall_scheme(wall_list("newmark", "static"));
  scheme->set_step_size(0.1);
  Timeline history = remembered_by(*scheme, 3);
  scheme->accept({1, 2, 3}, history);
  TEST_EQUALITY(scheme->inertia(7.0), 0.0);
  TEST_ASSERT(scheme->inertia_loads(history) == stepping::Rows(3, 0.0));
  TEST_ASSERT(history[0] == stepping::Rows(3, 0.0));
  TEST_EQUALITY(history.value()[1], 2.0);
}

}  // namespace
