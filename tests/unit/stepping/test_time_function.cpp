#include <Teuchos_Array.hpp>
#include <Teuchos_UnitTestHarness.hpp>
#include <cmath>
#include <cstdio>
#include <fstream>

#include "tunica/base/error.hpp"
#include "tunica/stepping/clock.hpp"
#include "tunica/stepping/time_function.hpp"

namespace {

using namespace tunica;
using stepping::TimeFunction;

Teuchos::ParameterList table_list(const std::vector<double>& times,
                                  const std::vector<double>& values,
                                  const std::string& interpolation) {
  Teuchos::ParameterList list;
  list.set("kind", std::string("table"));
  list.set("times", Teuchos::Array<double>(times));
  list.set("values", Teuchos::Array<double>(values));
  list.set("interpolation", interpolation);
  return list;
}

TimeFunction function_of(Teuchos::ParameterList list) {
  stepping::time_function_table().resolve(list, "Amplitude", "");
  return TimeFunction(list);
}

std::string refusal(const Teuchos::ParameterList& list) {
  try {
    function_of(list);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEUCHOS_UNIT_TEST(time_function, without_a_table_it_is_one) {
  TEST_EQUALITY(TimeFunction()(3.0), 1.0);
  TEST_EQUALITY(function_of({})(3.0), 1.0);
}

TEUCHOS_UNIT_TEST(time_function, linear_tables_interpolate_and_keep_their_end_values) {
  const TimeFunction f = function_of(table_list({1, 2, 4}, {10, 20, -20}, "linear"));
  const double times[] = {0.0, 1.0, 1.5, 2.0, 3.0, 4.0, 9.0};
  const double values[] = {10, 10, 15, 20, 0, -20, -20};
  for (int k = 0; k < 7; ++k) TEST_FLOATING_EQUALITY(f(times[k]) + 100, values[k] + 100, 1e-14);
}

TEUCHOS_UNIT_TEST(time_function, a_step_holds_from_its_time_to_the_next_inclusive) {
  const TimeFunction f = function_of(table_list({0, 1, 2}, {5, 6, 7}, "steps"));
  TEST_EQUALITY(f(-1.0), 5.0);
  TEST_EQUALITY(f(0.5), 5.0);
  TEST_EQUALITY(f(1.0), 5.0);
  TEST_EQUALITY(f(1.001), 6.0);
  TEST_EQUALITY(f(2.0), 6.0);
  TEST_EQUALITY(f(50.0), 7.0);
}

TEUCHOS_UNIT_TEST(time_function, rounding_of_n_steps_does_not_pass_the_end_of_a_pulse) {
  const TimeFunction pulse = function_of(table_list({0, 1}, {1, 0}, "steps"));
  for (const double dt : {0.1, 1.0 / 3.0, 1.0 / 7.0, 0.01, 1e-3}) {
    const int n = static_cast<int>(1.0 / dt + 0.5);
    stepping::Clock clock(dt, n + 1);
    for (int k = 1; k < n; ++k) clock.advance();
    TEST_EQUALITY(pulse(clock.time()), 1.0);
    clock.advance();
    TEST_EQUALITY(pulse(clock.time()), 0.0);
    double summed = 0.0;  // 0.1 ten times is 0.99999999999999989
    for (int k = 0; k < n; ++k) summed += dt;
    TEST_EQUALITY(pulse(summed), 1.0);
  }
}

Teuchos::ParameterList periodic(Teuchos::ParameterList list, double period) {
  list.set("period", period);
  return list;
}

TEUCHOS_UNIT_TEST(time_function, a_period_repeats_a_table_for_all_times) {
  // from 1 to 4 by the table, and from there to the first value
  const TimeFunction f = function_of(periodic(table_list({1, 2, 4}, {10, 20, -20}, "linear"), 5));
  const double times[] = {1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 6.0, 6.5, 13.0, 0.0, -3.0, 5001.5};
  const double values[] = {10, 15, 20, 0, -20, 10 - 15, 10, 15, 0, 10 - 15, 20, 15};
  for (int k = 0; k < 12; ++k) TEST_FLOATING_EQUALITY(f(times[k]) + 100, values[k] + 100, 1e-12);
  TEST_COMPARE_ARRAYS(f.kinks(7.5), (std::vector<double>{-4, -3, -1, 1, 2, 4, 6, 7, 9}));
}

TEUCHOS_UNIT_TEST(time_function, periodic_steps_hold_to_the_end_of_the_period_inclusive) {
  const TimeFunction f = function_of(periodic(table_list({0, 1}, {5, 6}, "steps"), 3));
  const double times[] = {0.0, 0.5, 1.0, 1.001, 3.0, 3.001, 4.0, 4.001, 3e5, -1.0};
  const double values[] = {6, 5, 5, 6, 6, 5, 5, 6, 6, 6};
  for (int k = 0; k < 10; ++k) TEST_EQUALITY(f(times[k]), values[k]);
}

TEUCHOS_UNIT_TEST(time_function, a_spline_with_flat_ends_is_exact_for_cubics_that_have_them) {
  const auto smooth = [](double t) { return t * t * (3.0 - 2.0 * t); };
  std::vector<double> times{0.0, 0.1, 0.25, 0.7, 1.0}, values;
  for (const double t : times) values.push_back(smooth(t));
  const TimeFunction f = function_of(table_list(times, values, "spline"));
  for (double t = 0.0; t <= 1.0; t += 0.01) TEST_FLOATING_EQUALITY(1 + f(t), 1 + smooth(t), 1e-13);
  TEST_EQUALITY(f(-2.0), 0.0);
  TEST_EQUALITY(f(7.0), 1.0);
  TEST_ASSERT(f.kinks(100.0).empty());
}

/// Largest error of a periodic spline through n uneven samples of a wave.
double spline_error(int n) {
  const auto wave = [](double t) { return std::sin(2.0 * M_PI * t / 8.0) + 0.3; };
  std::vector<double> times, values;
  for (int k = 0; k < n; ++k) {
    const double x = double(k) / n;
    times.push_back(8.0 * (x + 0.1 * std::sin(2.0 * M_PI * x)));
    values.push_back(wave(times.back()));
  }
  const TimeFunction f = function_of(periodic(table_list(times, values, "spline"), 8.0));
  double worst = 0.0;
  for (double t = -16.0; t < 16.0; t += 0.013) worst = std::max(worst, std::abs(f(t) - wave(t)));
  return worst;
}

TEUCHOS_UNIT_TEST(time_function, a_periodic_spline_is_of_fourth_order_across_its_ends_too) {
  TEST_FLOATING_EQUALITY(std::log2(spline_error(40) / spline_error(80)), 4.0, 0.03);
}

TEUCHOS_UNIT_TEST(time_function, a_fourier_series_is_the_sum_of_its_waves) {
  Teuchos::ParameterList list;
  list.set("kind", "fourier").set("period", 800.0).set("mean", 0.4);
  list.set("cosines", Teuchos::Array<double>(Teuchos::tuple(0.0, 2.0)));
  list.set("sines", Teuchos::Array<double>(Teuchos::tuple(1.0)));
  const TimeFunction f = function_of(list);
  for (const double t : {0.0, 100.0, 333.0, 800.0, 8133.0, -50.0}) {
    const double x = 2.0 * M_PI * t / 800.0;
    TEST_FLOATING_EQUALITY(10 + f(t), 10.4 + 2.0 * std::cos(2.0 * x) + std::sin(x), 1e-12);
  }
}

TEUCHOS_UNIT_TEST(time_function, periods_and_splines_that_cannot_be_are_refused) {
  const auto refused = [](const Teuchos::ParameterList& list, const std::string& what) {
    return refusal(list).find(what) != std::string::npos;
  };
  TEST_ASSERT(refused(periodic(table_list({0, 9}, {1, 1}, "linear"), 8), "period of 8 ms"));
  TEST_ASSERT(refused(periodic(table_list({0, 8}, {1, 2}, "linear"), 8), "the values differ"));
  TEST_EQUALITY(refusal(periodic(table_list({0, 4, 8}, {1, 2, 1}, "spline"), 8)), "");
  TEST_ASSERT(refused(table_list({3}, {1}, "spline"), "needs more times"));
  TEST_ASSERT(refused(periodic(table_list({0, 8}, {1, 1}, "spline"), 8), "needs more times"));
}

// 1.2 Hz: a heart of 72 beats a minute, whose period has no end of digits.
TEUCHOS_UNIT_TEST(time_function, a_table_of_one_period_may_have_other_digits_than_the_period) {
  for (const std::string between : {"linear", "spline"})
    for (const double end : {833.33333, 833.333, 833.33}) {
      const TimeFunction f = function_of(
          periodic(table_list({0, 400, end}, {20.1234561, 40, 20.1234569}, between), 833.333));
      for (const double t : {0.0, 833.333, 8333.33})
        TEST_FLOATING_EQUALITY(f(t), 20.1234561, 1e-12);
      TEST_FLOATING_EQUALITY(f(400.0 + 833.333), 40.0, 1e-12);
    }
  const std::string said = refusal(
      periodic(table_list({0, 400, 833.3395, 833.34}, {20, 40, 20, 20}, "linear"), 833.333));
  TEST_ASSERT(said.find("span 833.34 ms, more than the period of 833.333 ms") != std::string::npos);
}

TEUCHOS_UNIT_TEST(time_function, messages_tell_the_numbers_apart_that_they_compare) {
  const auto said = [](const std::vector<double>& times, const std::vector<double>& values) {
    return refusal(periodic(table_list(times, values, "linear"), 833.333));
  };
  const auto holds = [](const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
  };
  TEST_ASSERT(
      holds(said({0, 400, 833.333}, {1000, 1000.004, 1000.001}), "1000 first and 1000.001 last"));
  TEST_ASSERT(holds(said({0, 400.00002, 400.00001}, {1, 2, 1}),
                    "400.00001 ms follows 400.00002 ms, which is time 2 of 3"));
}

TEUCHOS_UNIT_TEST(time_function, files_are_replaced_by_their_samples_at_any_depth) {
  const std::string file = "inline_files.csv";
  std::ofstream(file) << "time,factor\n0,1\n2,5\n";
  Teuchos::ParameterList amplitude;
  amplitude.set("kind", std::string("file"));
  amplitude.set("file", file);
  stepping::time_function_table().resolve(amplitude, "Amplitude", ".");
  Teuchos::ParameterList list;
  list.sublist("Fluid").sublist("Amplitude") = amplitude;
  stepping::inline_files(list);
  std::remove(file.c_str());
  TEST_EQUALITY(TimeFunction(list.sublist("Fluid").sublist("Amplitude"))(1.0), 3.0);
}

TEUCHOS_UNIT_TEST(time_function, tables_that_make_no_sense_are_refused) {
  TEST_ASSERT(refusal(table_list({0, 2, 1}, {1, 1, 1}, "linear")).find("1 ms follows 2 ms") !=
              std::string::npos);
  TEST_ASSERT(refusal(table_list({0, 1, 1}, {1, 1, 1}, "linear")).find("increase") !=
              std::string::npos);
  TEST_ASSERT(refusal(table_list({0, 1}, {1}, "linear")).find("2 times but 1 values") !=
              std::string::npos);
  TEST_ASSERT(refusal(table_list({}, {}, "linear")).find("empty") != std::string::npos);
}

TEUCHOS_UNIT_TEST(time_function, files_hold_a_heading_comments_and_pairs) {
  const std::string name = "time_function_test.csv";
  std::ofstream(name) << "time_ms,factor\n# rises\n0, 0\n2, 4\n";
  Teuchos::ParameterList list;
  list.set("kind", std::string("file"));
  list.set("file", name);
  TEST_EQUALITY(function_of(list)(0.5), 1.0);
  // as spreadsheets write it
  for (const std::string text : {"\xef\xbb\xbftime_ms,factor\r\n0,0\r\n2,4\r\n",
                                 "\xef\xbb\xbf"
                                 "0,0\r\n2,4\r\n",
                                 "time,factor\r0,0\r2,4\r"}) {
    std::ofstream(name, std::ios::binary) << text;
    TEST_EQUALITY(function_of(list)(0.5), 1.0);
  }
  std::ofstream(name) << "0, 0\n2; 4\n";
  TEST_ASSERT(refusal(list).find(":2: expected a time and a value") != std::string::npos);
  std::remove(name.c_str());
}

}  // namespace
