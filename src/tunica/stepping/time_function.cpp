#include "tunica/stepping/time_function.hpp"

#include <Teuchos_Array.hpp>
#include <algorithm>
#include <cctype>
#include <cmath>
#include <fstream>
#include <sstream>

#include "tunica/base/error.hpp"

namespace tunica::stepping {

namespace {

struct Samples {
  std::vector<double> times;
  std::vector<double> values;
};

Samples read_samples(const std::string& file) {
  std::ifstream in(file);
  TUNICA_CHECK(in, file + ": cannot be read.");
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

void check_samples(const Teuchos::ParameterList& options, const std::string& path) {
  if (options.get<std::string>("kind") == "constant") return;
  const Samples s = samples_of(options);
  TUNICA_CHECK(!s.times.empty(), path + ": the table is empty, expected at least one time.");
  TUNICA_CHECK(s.times.size() == s.values.size(), path + ": " + std::to_string(s.times.size()) +
                                                      " times but " +
                                                      std::to_string(s.values.size()) + " values.");
  for (std::size_t i = 1; i < s.times.size(); ++i) {
    std::ostringstream message;
    message << path << ": the times must increase, but " << s.times[i] << " ms follows "
            << s.times[i - 1] << " ms.";
    TUNICA_CHECK(s.times[i] > s.times[i - 1], message.str());
  }
}

bool is_amplitude(const Teuchos::ParameterList& list) {
  return list.isParameter("kind") && list.isParameter("interpolation");
}

}  // namespace

TimeFunction::TimeFunction(const Teuchos::ParameterList& options) {
  if (options.get<std::string>("kind") == "constant") return;
  const Samples samples = samples_of(options);
  times_ = samples.times;
  values_ = samples.values;
  has_steps_ = options.get<std::string>("interpolation") == "steps";
}

void inline_files(Teuchos::ParameterList& list) {
  if (is_amplitude(list) && list.get<std::string>("kind") == "file") {
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
  if (times_.empty()) return 1.0;
  const double slack = 1e-9 * std::max(std::abs(time), std::abs(times_.back()));
  if (has_steps_) {
    // Round-off in n Δt must not push a step past its end.
    const auto next = std::lower_bound(times_.begin(), times_.end(), time - slack);
    return values_[next == times_.begin() ? 0 : next - times_.begin() - 1];
  }
  if (time <= times_.front()) return values_.front();
  if (time >= times_.back()) return values_.back();
  const std::size_t i = std::upper_bound(times_.begin(), times_.end(), time) - times_.begin();
  const double s = (time - times_[i - 1]) / (times_[i] - times_[i - 1]);
  return (1.0 - s) * values_[i - 1] + s * values_[i];
}

std::vector<double> TimeFunction::kinks() const {
  std::vector<double> found;
  double slope = 0.0;  // before the first time
  for (std::size_t i = 0; i < times_.size(); ++i) {
    const bool is_end = i + 1 == times_.size();
    const double next = is_end ? 0.0 : (values_[i + 1] - values_[i]) / (times_[i + 1] - times_[i]);
    const bool jumps = i > 0 && values_[i] != values_[i - 1];
    // Slopes that round-off alone tells apart are no kink.
    const double difference = std::abs(next - slope);
    const bool bends = difference > 1e-9 * std::max(std::abs(next), std::abs(slope));
    if (has_steps_ ? jumps : bends) found.push_back(times_[i]);
    slope = next;
  }
  return found;
}

std::vector<double> kinks(const Teuchos::ParameterList& list) {
  std::vector<double> all;
  if (is_amplitude(list)) all = TimeFunction(list).kinks();
  for (auto it = list.begin(); it != list.end(); ++it) {
    if (!list.isSublist(list.name(it))) continue;
    const std::vector<double> inner = kinks(list.sublist(list.name(it)));
    all.insert(all.end(), inner.begin(), inner.end());
  }
  return all;
}

params::Table time_function_table() {
  const auto interpolation = [](params::Table& table) {
    table.choice("interpolation", "linear", {"linear", "steps"},
                 "between the times: linear, or the value of the last time passed");
  };
  params::Table arrays, file;
  arrays.numbers("times", std::nullopt, params::any(), 0, "ms", "increasing times")
      .numbers("values", std::nullopt, params::any(), 0, "1", "factor at each time");
  interpolation(arrays);
  file.file("file", std::nullopt, "text file with a time and a value on each line");
  interpolation(file);
  params::Table table("Factor that depends on time.");
  table
      .variant("kind", "constant",
               {{"constant", params::Table("one at all times")}, {"table", arrays}, {"file", file}},
               "where the factor comes from")
      .check(check_samples);
  return table;
}

}  // namespace tunica::stepping
