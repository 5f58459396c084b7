#pragma once
#include <array>
#include <deque>
#include <string>
#include <vector>

#include "tunica/fields/state.hpp"
#include "tunica/stepping/clock.hpp"

namespace tunica::stepping {

/// Numbers of all local places, those of a place side by side.
using Rows = std::vector<double>;

/// History of a quantity: a row of numbers at each place, for the last step and as many earlier
/// ones as requested, and the additional quantities of a time scheme (a velocity, an acceleration),
/// each by its name. Zero at the start.
///
/// It can be saved and restored, and thus returned to the start of a step, by itself or within the
/// state of its owner.
class Timeline final : public fields::Restartable {
public:
  /// width: numbers per place; names: of what is added, TimeScheme::remembers(); n_values: of how
  /// many steps the values are kept.
  Timeline(fields::Places places, int width, std::vector<std::string> names = {}, int n_values = 1);

  int width() const { return width_; }
  /// Value of this many steps before the last; it must be kept.
  const Rows& value(int steps_before = 0) const { return values_[steps_before]; }
  Rows& value(int steps_before = 0) { return values_[steps_before]; }
  /// Steps whose values there are: 1 at the start, at most n_values.
  int n_kept() const { return static_cast<int>(values_.size()); }

  const std::vector<std::string>& names() const { return names_; }
  /// Additional quantity with the name at this position.
  const Rows& operator[](int k) const { return added_[k]; }
  Rows& operator[](int k) { return added_[k]; }

  /// x becomes the value of the last step, and the one before it moves back.
  void push(Rows x);
  /// As if all there has been were x.
  void start_from(Rows x);
  /// The polynomial through the last values, of the degree or as far as they go, at the end of the
  /// clock's step.
  Rows extrapolated(int degree, const StepSizes& sizes) const;

  // Restartable
  fields::State save() const override;
  std::string restore(const fields::State& state) override;

  /// Saves the past within a state on its owned places, under names with this prefix, without the
  /// value of the last step, which the state contains elsewhere.
  void save_past(const std::string& prefix, fields::State& state) const;
  /// last: the value that was left out. Throws Error where something is missing. Collective where
  /// places have copies.
  void restore_past(const std::string& prefix, const fields::State& state, Rows last);

  /// All numbers, for a row that is everywhere; and back, from as many.
  std::vector<double> numbers() const;
  void set_numbers(const std::vector<double>& numbers);

private:
  fields::Places places_;
  int width_, n_values_;
  std::vector<std::string> names_;
  std::deque<Rows> values_;  ///< newest first
  std::vector<Rows> added_;
};

}  // namespace tunica::stepping
