#include "tunica/stepping/time_function.hpp"

#include <Teuchos_Array.hpp>
#include <algorithm>
#include <cctype>
#include <cmath>
#include <sstream>

#include "tunica/base/error.hpp"
#include "tunica/base/formatted.hpp"
#include "tunica/base/told_apart.hpp"
#include "tunica/params/plain_text.hpp"
#include "tunica/stepping/period.hpp"

namespace tunica::stepping {

namespace {

struct Samples {
  std::vector<double> times;
  std::vector<double> values;
};

Samples read_samples(const std::string& file) {
  std::istringstream in(params::read_plain_text(file));
  Samples samples;
  std::string line;
  for (int number = 1; std::getline(in, line); ++number) {
    if (line.empty() || line[0] == '#') continue;
    std::replace(line.begin(), line.end(), ',', ' ');
    std::istringstream words(line);
    double time = 0.0, value = 0.0;
    std::string rest;
    const bool is_pair = static_cast<bool>(words >> time >> value) && !(words >> rest);
    if (!is_pair && number == 1 && std::isalpha(static_cast<unsigned char>(line[0])))
      continue;  // a heading
    TUNICA_CHECK(is_pair, file + ":" + std::to_string(number) +
                              ": expected a time and a value, found \"" + line + "\".");
    samples.times.push_back(time);
    samples.values.push_back(value);
  }
  return samples;
}

Samples samples_of(const Teuchos::ParameterList& options) {
  if (options.get<std::string>("kind") == "file")
    return read_samples(options.get<std::string>("file"));
  return {options.get<Teuchos::Array<double>>("times").toVector(),
          options.get<Teuchos::Array<double>>("values").toVector()};
}

bool has_samples(const Teuchos::ParameterList& options) {
  return options.isParameter("interpolation");
}

/// What a periodic table has within one period, and the first value once more where that ends.
void close_period(double period, Samples& s) {
  if (!closes_period(period, s.times)) {
    s.times.push_back(s.times.front() + period);
    s.values.push_back(s.values.front());
  }
  s.values.back() = s.values.front();
}

/// A last value that is not the first one to the digits with which tables are written.
void check_closed(double period, Samples s, const std::string& path) {
  constexpr double round_off = 1e-4;  // of the range
  const std::string last = formatted("%g", s.times.back());
  if (!closes_period(period, s.times)) return;
  const auto [low, high] = std::minmax_element(s.values.begin(), s.values.end());
  const double first_value = s.values.front(), last_value = s.values.back();
  const auto [first_text, last_text] = told_apart(first_value, last_value);
  TUNICA_CHECK(
      std::abs(last_value - first_value) <= round_off * (*high - *low),
      path + ": the last time, " + last +
          " ms, lies a period behind the first one, but the values differ: " + first_text +
          " first and " + last_text +
          " last. Omit the last time, which repeats the first one, or make the values equal.");
}

void check_period(const Teuchos::ParameterList& options, const std::string& path, Samples s) {
  const double period = options.get<double>("period");
  const bool is_spline = options.get<std::string>("interpolation") == "spline";
  if (period > 0.0) {
    check_span(period, s.times, path);
    if (options.get<std::string>("interpolation") != "steps") check_closed(period, s, path);
    close_period(period, s);
  }
  TUNICA_CHECK(!is_spline || s.times.size() >= (period > 0.0 ? 3U : 2U),
               path + ": a spline needs more times.");
}

void check_samples(const Teuchos::ParameterList& options, const std::string& path) {
  if (!has_samples(options)) return;
  const Samples s = samples_of(options);
  TUNICA_CHECK(!s.times.empty(), path + ": the table is empty, expected at least one time.");
  TUNICA_CHECK(s.times.size() == s.values.size(), path + ": " + std::to_string(s.times.size()) +
                                                      " times but " +
                                                      std::to_string(s.values.size()) + " values.");
  for (std::size_t i = 1; i < s.times.size(); ++i) {
    const auto [next, last] = told_apart(s.times[i], s.times[i - 1]);
    TUNICA_CHECK(s.times[i] > s.times[i - 1], path + ": the times must increase, but " + next +
                                                  " ms follows " + last + " ms, which is time " +
                                                  std::to_string(i) + " of " +
                                                  std::to_string(s.times.size()) + ".");
  }
  check_period(options, path, s);
}

bool is_file(const Teuchos::ParameterList& list) {
  return list.isParameter("kind") && has_samples(list) && list.get<std::string>("kind") == "file";
}

std::vector<double> numbers(const Teuchos::ParameterList& options, const std::string& key) {
  return options.get<Teuchos::Array<double>>(key).toVector();
}

/// Time since the beginning of a period, which itself counts as its end where at_end.
double within(double time, double begin, double period, bool at_end) {
  double since = std::fmod(time - begin, period);
  if (since < 0.0) since += period;
  // Round-off in sums of Δt must not push a step past its end.
  const double slack = 1e-9 * period + 1e-12 * std::abs(time);
  if (at_end && since <= slack) since = period;
  if (!at_end && since >= period - slack) since = 0.0;
  return since;
}

}  // namespace

TimeFunction::TimeFunction(const Teuchos::ParameterList& options) {
  const auto& kind = options.get<std::string>("kind");
  if (kind == "constant") return;
  period_ = options.get<double>("period");
  if (kind == "fourier") {
    kind_ = Kind::fourier;
    mean_ = options.get<double>("mean");
    cosines_ = numbers(options, "cosines");
    sines_ = numbers(options, "sines");
    return;
  }
  Samples samples = samples_of(options);
  if (period_ > 0.0) close_period(period_, samples);
  times_ = samples.times;
  values_ = samples.values;
  const auto& between = options.get<std::string>("interpolation");
  kind_ = between == "steps" ? Kind::steps : between == "spline" ? Kind::spline : Kind::linear;
  if (kind_ == Kind::spline) spline_ = Spline(times_, values_, period_ > 0.0);
}

double gap_in_period(const Teuchos::ParameterList& amplitude) {
  if (!has_samples(amplitude)) return 0.0;
  const double period = amplitude.get<double>("period");
  // A value of a table of steps holds, however long.
  if (period == 0.0 || amplitude.get<std::string>("interpolation") == "steps") return 0.0;
  Samples s = samples_of(amplitude);
  const double gap = s.times.front() + period - s.times.back();
  if (s.times.size() < 2 || closes_period(period, s.times)) return 0.0;
  const auto [low, high] = std::minmax_element(s.values.begin(), s.values.end());
  if (std::abs(s.values.back() - s.values.front()) <= 0.01 * (*high - *low)) return 0.0;
  double longest = 0.0;
  for (std::size_t i = 1; i < s.times.size(); ++i)
    longest = std::max(longest, s.times[i] - s.times[i - 1]);
  return gap > 2.0 * longest ? gap : 0.0;
}

void inline_files(Teuchos::ParameterList& list) {
  if (is_file(list)) {
    const Samples samples = read_samples(list.get<std::string>("file"));
    list.set("kind", "table");
    list.set("times", Teuchos::Array<double>(samples.times));
    list.set("values", Teuchos::Array<double>(samples.values));
    list.remove("file");
  }
  for (auto it = list.begin(); it != list.end(); ++it)
    if (list.isSublist(list.name(it))) inline_files(list.sublist(list.name(it)));
}

double TimeFunction::operator()(double time) const {
  if (kind_ == Kind::constant) return 1.0;
  if (kind_ == Kind::fourier) {
    double sum = mean_;
    const double phase = 2.0 * M_PI / period_ * within(time, 0.0, period_, false);
    for (std::size_t k = 0; k < cosines_.size(); ++k)
      sum += cosines_[k] * std::cos(double(k + 1) * phase);
    for (std::size_t k = 0; k < sines_.size(); ++k)
      sum += sines_[k] * std::sin(double(k + 1) * phase);
    return sum;
  }
  if (period_ == 0.0) return in_table(time);
  return in_table(times_.front() + within(time, times_.front(), period_, kind_ == Kind::steps));
}

double TimeFunction::span() const {
  if (period_ > 0.0) return period_;
  return times_.empty() ? 0.0 : times_.back();
}

std::pair<double, double> TimeFunction::table_range() const {
  if (values_.empty()) return {0.0, 0.0};
  const auto [least, largest] = std::minmax_element(values_.begin(), values_.end());
  return {*least, *largest};
}

double TimeFunction::in_table(double time) const {
  const double slack = 1e-9 * std::max(std::abs(time), std::abs(times_.back()));
  if (kind_ == Kind::steps) {
    // Round-off in n Δt must not push a step past its end.
    const auto next = std::lower_bound(times_.begin(), times_.end(), time - slack);
    return values_[next == times_.begin() ? 0 : next - times_.begin() - 1];
  }
  if (time <= times_.front()) return values_.front();
  if (time >= times_.back()) return values_.back();
  if (kind_ == Kind::spline) return spline_(time);
  const std::size_t i = std::upper_bound(times_.begin(), times_.end(), time) - times_.begin();
  const double s = (time - times_[i - 1]) / (times_[i] - times_[i - 1]);
  return (1.0 - s) * values_[i - 1] + s * values_[i];
}

std::vector<double> TimeFunction::kinks_of_table() const {
  std::vector<double> found;
  if (kind_ != Kind::linear && kind_ != Kind::steps) return found;
  const std::size_t n = times_.size();
  const auto slope_behind = [&](std::size_t i) {
    return i + 1 == n ? 0.0 : (values_[i + 1] - values_[i]) / (times_[i + 1] - times_[i]);
  };
  const bool is_periodic = period_ > 0.0;
  double slope = is_periodic && n > 1 ? slope_behind(n - 2) : 0.0;  // before the first time
  for (std::size_t i = 0; i < (is_periodic ? n - 1 : n); ++i) {
    const double next = slope_behind(i);
    const double before = i > 0 ? values_[i - 1] : is_periodic ? values_[n - 2] : values_[0];
    // Slopes that round-off alone tells apart are no kink.
    const double difference = std::abs(next - slope);
    const bool bends = difference > 1e-9 * std::max(std::abs(next), std::abs(slope));
    if (kind_ == Kind::steps ? values_[i] != before : bends) found.push_back(times_[i]);
    slope = next;
  }
  return found;
}

std::vector<double> TimeFunction::kinks(double end) const {
  const std::vector<double> once = kinks_of_table();
  if (period_ == 0.0 || once.empty()) return once;
  constexpr double most = 1e7;
  TUNICA_CHECK(static_cast<double>(once.size()) * (end / period_) < most,
               "Amplitude: \"period\" is so short that steps would have to end at more than ten "
               "million kinks of the load. Set \"hit kinks\" of \"Time\" to false.");
  std::vector<double> all;
  const double first = std::floor(-times_.front() / period_);
  for (double k = first; once.front() + k * period_ <= end; ++k)
    for (const double time : once) all.push_back(time + k * period_);
  return all;
}

std::vector<double> kinks(const Teuchos::ParameterList& list, double end) {
  std::vector<double> all;
  if (list.isParameter("kind") && has_samples(list)) all = TimeFunction(list).kinks(end);
  for (auto it = list.begin(); it != list.end(); ++it) {
    if (!list.isSublist(list.name(it))) continue;
    const std::vector<double> inner = kinks(list.sublist(list.name(it)), end);
    all.insert(all.end(), inner.begin(), inner.end());
  }
  return all;
}

params::Table time_function_table() {
  const auto of_samples = [](params::Table& table) {
    table
        .choice("interpolation", "linear", {"linear", "spline", "steps"},
                "between the times: linear, a cubic spline, or the value of the last time passed")
        .number("period", 0.0, params::non_negative(), "ms",
                "period after which the table is repeated, for all times; its times must not span "
                "more; 0: not periodic, its first and last values hold before and after");
  };
  params::Table arrays, file, fourier;
  arrays.numbers("times", std::nullopt, params::any(), 0, "ms", "increasing times")
      .numbers("values", std::nullopt, params::any(), 0, "1", "factor at each time");
  of_samples(arrays);
  file.file("file", std::nullopt, "text file with a time and a value on each line");
  of_samples(file);
  fourier.number("period", std::nullopt, params::positive(), "ms", "period of the first harmonic")
      .number("mean", 0.0, params::any(), "1",
              "a_0 of a_0 + sum a_k cos(2 pi k t/T) + b_k sin(...)")
      .numbers("cosines", std::vector<double>{}, params::any(), 0, "1", "a_1, a_2, ...")
      .numbers("sines", std::vector<double>{}, params::any(), 0, "1", "b_1, b_2, ...");
  params::Table table("Factor that depends on time.");
  table
      .variant("kind", "constant",
               {{"constant", params::Table("one at all times")},
                {"table", arrays},
                {"file", file},
                {"fourier", fourier}},
               "source of the factor")
      .check(check_samples);
  return table;
}

}  // namespace tunica::stepping
