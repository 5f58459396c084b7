#include "tunica/stepping/timeline.hpp"

#include <algorithm>

namespace tunica::stepping {

namespace {

constexpr const char* value_name = "value";

std::string name_of_value(const std::string& prefix, int steps_before) {
  return prefix + std::to_string(steps_before) + " before";
}

}  // namespace

Timeline::Timeline(fields::Places places, int width, std::vector<std::string> names, int n_values)
    : places_(std::move(places)), width_(width), n_values_(n_values), names_(std::move(names)),
      values_(1, Rows(places_.count() * width)),
      added_(names_.size(), Rows(places_.count() * width)) {}

void Timeline::push(Rows x) {
  values_.push_front(std::move(x));
  if (n_kept() > n_values_) values_.pop_back();
}

void Timeline::start_from(Rows x) {
  values_.clear();
  values_.push_back(std::move(x));
}

// Σ_k c_k xⁿ⁻ᵏ
Rows Timeline::extrapolated(int degree, const StepSizes& sizes) const {
  const int known = std::min(degree, n_kept() - 1);
  const std::array<double, 3> c = extrapolation(known, sizes);
  Rows x(values_.front().size(), 0.0);
  for (int k = 0; k <= known; ++k)
    for (std::size_t i = 0; i < x.size(); ++i) x[i] += c[k] * values_[k][i];
  return x;
}

fields::State Timeline::save() const {
  fields::State state = places_.state();
  state.arrays[value_name] = places_.owned_rows(values_.front(), width_);
  save_past("", state);
  return state;
}

std::string Timeline::restore(const fields::State& state) {
  restore_past("", state, places_.local_rows(state, value_name, width_));
  return "";
}

void Timeline::save_past(const std::string& prefix, fields::State& state) const {
  for (std::size_t k = 0; k < names_.size(); ++k)
    state.arrays[prefix + names_[k]] = places_.owned_rows(added_[k], width_);
  for (int k = 1; k < n_kept(); ++k)
    state.arrays[name_of_value(prefix, k)] = places_.owned_rows(values_[k], width_);
}

void Timeline::restore_past(const std::string& prefix, const fields::State& state, Rows last) {
  for (std::size_t k = 0; k < names_.size(); ++k)
    added_[k] = places_.local_rows(state, prefix + names_[k], width_);
  start_from(std::move(last));
  for (int k = 1; k < n_values_ && state.has_array(name_of_value(prefix, k)); ++k)
    values_.push_back(places_.local_rows(state, name_of_value(prefix, k), width_));
}

std::vector<double> Timeline::numbers() const {
  std::vector<double> all(values_.front());
  for (const Rows& rows : added_) all.insert(all.end(), rows.begin(), rows.end());
  return all;
}

void Timeline::set_numbers(const std::vector<double>& numbers) {
  auto next = numbers.begin();
  const auto take = [&](Rows& rows) {
    std::copy_n(next, rows.size(), rows.begin());
    next += static_cast<std::ptrdiff_t>(rows.size());
  };
  take(values_.front());
  for (Rows& rows : added_) take(rows);
}

}  // namespace tunica::stepping
