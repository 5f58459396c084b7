#include <Teuchos_UnitTestHarness.hpp>
#include <cmath>

#include "tunica/base/error.hpp"
#include "tunica/stepping/bdf2.hpp"
#include "tunica/stepping/implicit_euler.hpp"
#include "tunica/stepping/newmark.hpp"
#include "tunica/stepping/step_control.hpp"
#include "tunica/stepping/time_function.hpp"

namespace {

using namespace tunica;
using stepping::Clock;
using stepping::StepControl;

StepControl fixed(double step_size, int steps, int cuts, std::vector<double> asked_for = {}) {
  Teuchos::ParameterList list;
  list.set("step size", step_size).set("steps", steps).set("cuts", cuts);
  stepping::time_table().resolve(list, "Time", "");
  return {stepping::step_control_options(list), {}, std::move(asked_for)};
}

Teuchos::ParameterList adaptive_list(double first, double end) {
  Teuchos::ParameterList list;
  list.set("step size", first).set("step control", "adaptive").set("end time", end);
  stepping::time_table().resolve(list, "Time", "");
  return list;
}

StepControl adaptive(const Teuchos::ParameterList& list, std::vector<double> kinks = {},
                     std::vector<double> asked_for = {}) {
  return {stepping::step_control_options(list), std::move(kinks), std::move(asked_for)};
}

/// Ends of the steps to the end, each too long by eta.
std::vector<double> times_of(StepControl control, double eta = 1.0) {
  std::vector<double> times;
  for (; !control.is_done(); control.advance(eta)) times.push_back(control.clock().time());
  return times;
}

TEUCHOS_UNIT_TEST(step_control, fixed_steps_are_those_of_the_clock) {
  StepControl control = fixed(0.1, 50, 3);
  for (Clock clock(0.1, 50); !clock.is_done(); clock.advance(), control.advance()) {
    TEST_EQUALITY(control.clock().time(), clock.time());
    TEST_EQUALITY(control.clock().step_size(), clock.step_size());
    TEST_EQUALITY(control.clock().previous_step_size(), clock.previous_step_size());
    TEST_EQUALITY(control.clock().count(), clock.count());
    TEST_EQUALITY(control.clock().is_last(), clock.is_last());
  }
  TEST_ASSERT(control.is_done());
}

TEUCHOS_UNIT_TEST(step_control, a_fixed_step_that_fails_is_halved_and_the_size_returns) {
  StepControl control = fixed(1.0, 3, 2);
  control.advance();
  TEST_ASSERT(control.cut());
  TEST_EQUALITY(control.clock().time(), 1.5);
  TEST_ASSERT(control.cut());
  TEST_EQUALITY(control.clock().time(), 1.25);
  TEST_EQUALITY(control.clock().previous_step_size(), 1.0);
  TEST_ASSERT(!control.cut());  // often enough
  TEST_EQUALITY(control.clock().count(), 0);
  const std::vector<double> expected{1.25, 1.625, 2.0, 3.0};  // a half twice, then whole steps
  TEST_COMPARE_ARRAYS(times_of(control, 0.0), expected);
}

TEUCHOS_UNIT_TEST(step_control, fixed_steps_stop_where_fields_are_asked_for) {
  const std::vector<double> expected{0.5, 0.7, 1.0, 1.5};
  TEST_COMPARE_FLOATING_ARRAYS(times_of(fixed(0.5, 3, 0, {0.7, 1.0})), expected, 1e-15);
}

TEUCHOS_UNIT_TEST(step_control, kinks_asked_times_and_the_end_are_hit_without_slivers) {
  StepControl control = adaptive(adaptive_list(0.3, 2.0), {0.8, 1.7}, {1.25});
  std::vector<double> hit;
  double last = 0.0, smallest = 1.0;
  for (; !control.is_done(); control.advance(0.8)) {
    const Clock& clock = control.clock();
    for (const double time : {0.8, 1.25, 1.7, 2.0})
      if (clock.time() == time) hit.push_back(time);
    TEST_EQUALITY(clock.is_asked_for(), clock.time() == 1.25);
    TEST_EQUALITY(clock.is_last(), clock.time() == 2.0);
    TEST_EQUALITY(clock.previous_step_size() == 0.0, last == 0.0 || last == 0.8 || last == 1.7);
    TEST_FLOATING_EQUALITY(clock.time() - last, clock.step_size(), 1e-12);
    smallest = std::min(smallest, clock.step_size());
    last = clock.time();
  }
  TEST_EQUALITY(hit.size(), 4);
  TEST_COMPARE(smallest, >=, 0.1);
}

TEUCHOS_UNIT_TEST(step_control, the_error_sets_the_next_step_within_bounds) {
  Teuchos::ParameterList list = adaptive_list(1.0, 1e6);
  list.set("largest step", 5.0);
  StepControl control = adaptive(list);
  control.advance(0.75);  // the first knows no error before: 0.9/η
  TEST_FLOATING_EQUALITY(control.clock().step_size(), 1.2, 1e-14);
  control.advance(0.8);  // 0.9 η⁻⁰·⁸ η₀⁰·²
  TEST_FLOATING_EQUALITY(control.clock().step_size(),
                         1.2 * 0.9 * std::pow(0.8, -0.8) * std::pow(0.75, 0.2), 1e-14);
  const double before = control.clock().step_size();
  control.advance(1e-9);
  TEST_FLOATING_EQUALITY(control.clock().step_size(), 2.0 * before, 1e-14);
  for (int k = 0; k < 5; ++k) control.advance(1e-9);
  TEST_EQUALITY(control.clock().step_size(), 5.0);
}

TEUCHOS_UNIT_TEST(step_control, keys_set_the_controller) {
  Teuchos::ParameterList list = adaptive_list(1.0, 1e6);
  list.set("safety", 0.8).set("integral gain", 0.3).set("proportional gain", 0.4);
  list.set("largest growth", 1.5).set("largest cut", 0.25).set("hit kinks", false).set("cuts", 1);
  StepControl control = adaptive(list);
  control.advance(0.7);
  TEST_FLOATING_EQUALITY(control.clock().step_size(), 0.8 / 0.7, 1e-14);
  control.advance(0.9);
  TEST_FLOATING_EQUALITY(control.clock().step_size(),
                         0.8 / 0.7 * 0.8 * std::pow(0.9, -0.7) * std::pow(0.7, 0.4), 1e-14);
  const double before = control.clock().step_size();
  control.advance(1e-6);
  TEST_FLOATING_EQUALITY(control.clock().step_size(), 1.5 * before, 1e-14);
  TEST_ASSERT(control.shorten(1e3));
  TEST_FLOATING_EQUALITY(control.clock().step_size(), 0.25 * 1.5 * before, 1e-14);
  TEST_ASSERT(control.cut());
  TEST_ASSERT(!control.cut());
}

TEUCHOS_UNIT_TEST(step_control, a_step_that_is_too_long_is_shortened_down_to_the_smallest) {
  Teuchos::ParameterList list = adaptive_list(1.0, 1e6);
  list.set("smallest step", 0.1);
  StepControl control = adaptive(list);
  TEST_ASSERT(control.shorten(1.8));
  TEST_FLOATING_EQUALITY(control.clock().step_size(), 0.5, 1e-14);
  // Half the step and η fallen by √2: it falls as √Δt, so that 0.9 (1.8/√2)⁻² is right.
  TEST_ASSERT(control.shorten(1.8 / std::sqrt(2.0)));
  TEST_FLOATING_EQUALITY(control.clock().step_size(), 0.5 * 0.9 / 1.62, 1e-12);
  TEST_ASSERT(control.shorten(100.0));
  TEST_EQUALITY(control.clock().step_size(), 0.1);
  TEST_ASSERT(!control.shorten(2.0));
  const double failed = std::nan("");
  StepControl other = adaptive(adaptive_list(1.0, 1e6));
  TEST_ASSERT(other.shorten(failed));
  TEST_FLOATING_EQUALITY(other.clock().step_size(), 0.1, 1e-14);  // the largest cut
  other.advance(0.01);
  TEST_FLOATING_EQUALITY(other.clock().step_size(), 0.1, 1e-14);  // does not grow at once
}

TEUCHOS_UNIT_TEST(step_control, goes_on_from_what_it_saved) {
  const Teuchos::ParameterList list = adaptive_list(0.1, 10.0);
  StepControl one = adaptive(list, {0.7, 3.0}, {1.0});
  double eta = 0.5;
  for (int k = 0; k < 9; ++k, eta = 1.4 - eta) one.advance(eta);
  StepControl other = adaptive(list, {0.7, 3.0}, {1.0});
  other.restore(one.save());
  for (; !one.is_done(); one.advance(eta), other.advance(eta), eta = 1.4 - eta) {
    TEST_EQUALITY(one.clock().step(), other.clock().step());
    TEST_EQUALITY(one.clock().time(), other.clock().time());
    TEST_EQUALITY(one.clock().step_size(), other.clock().step_size());
    TEST_EQUALITY(one.clock().previous_step_size(), other.clock().previous_step_size());
    TEST_EQUALITY(one.clock().step_sizes().before, other.clock().step_sizes().before);
  }
  TEST_ASSERT(other.is_done());
}

TEUCHOS_UNIT_TEST(step_control, the_first_step_lies_within_the_bounds) {
  Teuchos::ParameterList list;
  list.set("step size", 1.0).set("step control", "adaptive").set("end time", 2.0);
  list.set("largest step", 0.5);
  TEST_THROW(stepping::time_table().resolve(list, "Time", ""), Error);
  list.set("largest step", 0.0).set("smallest step", 1.5);
  TEST_THROW(stepping::time_table().resolve(list, "Time", ""), Error);
}

Teuchos::ParameterList steady_list() {
  Teuchos::ParameterList list;
  list.set("step size", 2.0).set("step control", "steady").set("steps", 9).set("cuts", 2);
  list.set("tolerance", 1e-4).set("infinite below", 0.1).set("load time", 3.0);
  list.set("smallest growth", 1.25).set("largest growth", 8.0);
  stepping::time_table().resolve(list, "Time", "");
  return list;
}

TEUCHOS_UNIT_TEST(pseudo_time, steps_grow_as_the_rate_falls_and_become_infinite) {
  StepControl control = adaptive(steady_list());
  TEST_EQUALITY(control.clock().time(), 3.0);
  control.advance(1e4);  // a change of one: the rate is 1/2
  TEST_EQUALITY(control.clock().step_size(), 2.5);
  control.advance(1e4 / 2.4);  // the rate is a sixth, a third of the one before
  TEST_FLOATING_EQUALITY(control.clock().step_size(), 7.5, 1e-14);
  control.advance(1e4 * 1.25 / 3.0);  // 1/18
  TEST_FLOATING_EQUALITY(control.clock().step_size(), 22.5, 1e-13);
  TEST_EQUALITY(control.clock().previous_step_size(), 0.0);
  control.advance(900.0);
  TEST_ASSERT(std::isinf(control.clock().step_size()));
  control.advance(20.0);
  TEST_ASSERT(!control.is_done());
  control.advance(0.9);
  TEST_ASSERT(control.is_done() && control.is_steady());
}

TEUCHOS_UNIT_TEST(pseudo_time, an_infinite_step_that_fails_makes_room_for_finite_ones) {
  StepControl control = adaptive(steady_list());
  control.advance(900.0);
  TEST_ASSERT(std::isinf(control.clock().step_size()));
  TEST_ASSERT(control.cut());
  TEST_EQUALITY(control.clock().step_size(), 2.5);
  TEST_ASSERT(control.cut());
  TEST_EQUALITY(control.clock().step_size(), 0.625);
  TEST_ASSERT(!control.cut());
  control.advance(900.0);  // small enough before, not now; nor does a step grow that was cut
  TEST_EQUALITY(control.clock().step_size(), 0.625);
  StepControl other = adaptive(steady_list());
  other.restore(control.save());
  for (StepControl* each : {&control, &other}) each->advance(90.0);
  TEST_ASSERT(std::isinf(control.clock().step_size()));
  TEST_ASSERT(std::isinf(other.clock().step_size()));
}

TEUCHOS_UNIT_TEST(pseudo_time, infinite_steps_that_do_not_settle_give_way_to_finite_ones) {
  StepControl control = adaptive(steady_list()), other = adaptive(steady_list());
  control.advance(900.0);
  for (const double change : {90.0, 50.0, 40.0}) control.advance(change);
  for (int k = 0; k < 9; ++k) control.advance(39.0 - k);
  TEST_ASSERT(std::isinf(control.clock().step_size()));
  other.restore(control.save());
  for (StepControl* each : {&control, &other}) {
    each->advance(30.0);  // the tenth, of which none is half of 40
    TEST_EQUALITY(each->clock().step_size(), 2.5);
    each->advance(20.0);
    TEST_EQUALITY(each->clock().step_size(), 2.5);
    TEST_ASSERT(!each->is_steady());
    each->advance(0.9);
    TEST_ASSERT(each->is_steady());
  }
}

TEUCHOS_UNIT_TEST(pseudo_time, steps_grow_up_to_the_largest_which_is_judged) {
  Teuchos::ParameterList list = steady_list();
  list.set("largest step", 40.0);
  StepControl control = adaptive(list);
  control.advance(1e4);
  TEST_EQUALITY(control.clock().step_size(), 2.5);
  control.advance(900.0);  // little
  TEST_EQUALITY(control.clock().step_size(), 40.0);
  TEST_ASSERT(control.cut());  // it was too early
  TEST_FLOATING_EQUALITY(control.clock().step_size(), 20.0, 1e-14);
  TEST_ASSERT(control.cut());
  TEST_FLOATING_EQUALITY(control.clock().step_size(), 5.0, 1e-14);
  control.advance(0.5);  // shorter steps say nothing
  TEST_ASSERT(!control.is_steady());
  TEST_EQUALITY(control.clock().step_size(), 40.0);
  control.advance(1.5);
  TEST_ASSERT(!control.is_steady());
  TEST_EQUALITY(control.clock().step_size(), 40.0);
  control.advance(0.9);
  TEST_ASSERT(control.is_done() && control.is_steady());
}

TEUCHOS_UNIT_TEST(extrapolation, is_exact_for_polynomials_and_whole_for_equal_steps) {
  const stepping::StepSizes sizes{0.5, 0.2, 0.3};
  const double times[3] = {0.0, -0.2, -0.5};
  for (int degree = 0; degree < 3; ++degree) {
    const auto weights = stepping::extrapolation(degree, sizes);
    double sum = 0.0;
    for (int k = 0; k < 3; ++k) sum += weights[k] * std::pow(times[k] + 1.0, degree);
    TEST_FLOATING_EQUALITY(sum, std::pow(1.5, degree), 1e-14);
  }
  const std::array<double, 3> linear{2, -1, 0}, quadratic{3, -3, 1};
  TEST_ASSERT(stepping::extrapolation(1, {0.1, 0.1, 0.1}) == linear);
  TEST_ASSERT(stepping::extrapolation(2, {0.1, 0.1, 0.1}) == quadratic);
}

TEUCHOS_UNIT_TEST(error_formula, bdf2_loses_what_it_says_of_a_cubic) {
  const auto x = [](double t) { return t * t * t - t; };
  for (const double h : {0.2, 0.5, 0.7}) {
    stepping::Bdf2 scheme(1);
    const stepping::StepSizes sizes{h, 0.5, 0.3};
    scheme.set_step_size(sizes.now, sizes.last);
    stepping::Timeline history(fields::Places::everywhere(), 1, scheme.remembers());
    history.value() = {x(0.0)};
    history[0] = {x(-0.5)};
    const double made = (3.0 * h * h - 1.0) / scheme.rate() + scheme.past(history, 0);
    const auto w = stepping::extrapolation(2, sizes);
    const double predicted = w[0] * x(0.0) + w[1] * x(-0.5) + w[2] * x(-0.8);
    const stepping::ErrorFormula formula = scheme.value_error(sizes);
    TEST_EQUALITY(formula.degree, 2);
    TEST_FLOATING_EQUALITY(made - x(h), formula.constant * (x(h) - predicted), 1e-12);
  }
  stepping::Bdf2 equal(1);
  equal.set_step_size(0.1, 0.1);
  TEST_FLOATING_EQUALITY(equal.value_error({0.1, 0.1, 0.1}).constant, 2.0 / 9.0, 1e-14);
  equal.set_step_size(0.1);
  TEST_EQUALITY(equal.value_error({0.1, 0.1, 0.1}).degree, 1);  // a step of Euler's
}

TEUCHOS_UNIT_TEST(error_formula, implicit_euler_loses_half_of_the_second_difference) {
  // ẋ = 2t by steps from x(0) = 0: xⁿ = xⁿ⁻¹ + 2 tⁿ Δt instead of (tⁿ)² − (tⁿ⁻¹)²
  stepping::ImplicitEuler scheme(1);
  double t = 0.0, x = 0.0, before = 0.0, last = 0.0;
  for (const double h : {0.1, 0.3, 0.2, 0.7}) {
    const double now = x + 2.0 * (t + h) * h, lost = now - x - ((t + h) * (t + h) - t * t);
    const auto w = stepping::extrapolation(1, {h, last, 0.0});
    if (last > 0.0)
      TEST_FLOATING_EQUALITY(
          lost, scheme.value_error({h, last, 0.0}).constant * (now - w[0] * x - w[1] * before),
          1e-12);
    before = x, x = now, t += h, last = h;
  }
}

TEUCHOS_UNIT_TEST(error_formula, newmark_loses_what_it_says_of_a_cubic) {
  // d = t³: v = 3t², a = 6t, of which the third derivative is 6, and that of v is constant
  for (const double gamma : {0.6, 1.0}) {
    const double h = 0.4, beta = 0.625, t = 1.0;
    stepping::Newmark scheme(beta, gamma);
    scheme.set_step_size(h, 0.3);
    const double a0 = 6.0 * t, a1 = 6.0 * (t + h);
    const double d = t * t * t + h * 3.0 * t * t + h * h * ((0.5 - beta) * a0 + beta * a1);
    const double v = 3.0 * t * t + h * ((1.0 - gamma) * a0 + gamma * a1);
    const stepping::StepSizes sizes{h, 0.3, 0.2};
    const auto predicted = [&](int degree, const std::function<double(double)>& f) {
      const auto w = stepping::extrapolation(degree, sizes);
      return w[0] * f(t) + w[1] * f(t - 0.3) + w[2] * f(t - 0.5);
    };
    const auto cube = [](double s) { return s * s * s; };
    const auto square = [](double s) { return 3.0 * s * s; };
    const auto of_d = scheme.value_error(sizes), of_v = scheme.velocity_error(sizes);
    TEST_FLOATING_EQUALITY(cube(t + h) - d,
                           of_d.constant * (cube(t + h) - predicted(of_d.degree, cube)), 1e-11);
    TEST_FLOATING_EQUALITY(square(t + h) - v,
                           of_v.constant * (square(t + h) - predicted(of_v.degree, square)), 1e-11);
  }
  TEST_EQUALITY(stepping::Newmark(0.25, 0.5).order(), 2);
  TEST_FLOATING_EQUALITY(stepping::Newmark(0.25, 0.5).velocity_error({0.1, 0.1, 0.1}).constant,
                         -1.0 / 12.0, 1e-13);
}

Teuchos::ParameterList amplitude(const std::string& interpolation) {
  Teuchos::ParameterList list("Amplitude");
  list.set("kind", "table").set("interpolation", interpolation);
  list.set("times", Teuchos::Array<double>(Teuchos::tuple(0.0, 1.0, 2.0, 3.0, 4.0)));
  list.set("values", Teuchos::Array<double>(Teuchos::tuple(0.0, 1.0, 2.0, 2.0, 5.0)));
  stepping::time_function_table().resolve(list, "Amplitude", "");
  return list;
}

TEUCHOS_UNIT_TEST(time_function, knows_where_it_is_not_smooth) {
  const std::vector<double> linear{0.0, 2.0, 3.0, 4.0}, steps{1.0, 2.0, 4.0};
  TEST_COMPARE_ARRAYS(stepping::TimeFunction(amplitude("linear")).kinks(100.0), linear);
  TEST_COMPARE_ARRAYS(stepping::TimeFunction(amplitude("steps")).kinks(100.0), steps);
  Teuchos::ParameterList fluid;
  fluid.sublist("Surfaces").sublist("inlet").sublist("Amplitude") = amplitude("steps");
  TEST_COMPARE_ARRAYS(stepping::kinks(fluid, 100.0), steps);
}

}  // namespace
