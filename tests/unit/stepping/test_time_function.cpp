#include <Teuchos_Array.hpp>
#include <Teuchos_UnitTestHarness.hpp>
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
  std::ofstream(name) << "0, 0\n2; 4\n";
  TEST_ASSERT(refusal(list).find(":2: expected a time and a value") != std::string::npos);
  std::remove(name.c_str());
}

}  // namespace
