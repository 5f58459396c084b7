#pragma once
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "tunica/params/table.hpp"
#include "tunica/stepping/clock.hpp"
#include "tunica/stepping/pseudo_time.hpp"

namespace tunica::stepping {

/// Sizes that a run may give to its steps.
struct StepControlOptions {
  bool is_adaptive;
  double first_step;
  double end;      ///< of the run [ms]
  int most_steps;  ///< of fixed size, or adaptive ones; 0: any
  int cuts;        ///< of a step that fails, in a row
  double cut;      ///< to what a step that fails is cut: times this
  double smallest, largest;
  double largest_cut, largest_growth;
  double safety;
  double integral_gain, proportional_gain;
  std::optional<PseudoTime> pseudo_time;  ///< as it begins, to a flow under the loads at `end`
};
StepControlOptions step_control_options(const Teuchos::ParameterList& time);

/// Chooses the steps of a run.
///
///   Δtⁿ⁺¹ = Δtⁿ s (ηⁿ)^−(k_I + k_P) (ηⁿ⁻¹)^k_P,   η = (error/permitted)^(1/(q + 1))
///
///   η    by what part the step is too long: where η > 1 the step is repeated        1
///   s    safety                                                                     1
///   k_I, k_P   integral and proportional gain; behind a step that was repeated, or the first,
///              k_I = 1, k_P = 0                                                     1
///   q+1  order of the local error in Δt                                             1
///
/// Fixed steps end at whole multiples of Δt. Some times are hit exactly: the end, where the fields
/// are asked for, and in adaptive runs where loads have kinks; a step in front of such a time is
/// stretched to it, or two share the way. Behind a kink a scheme begins anew. A step that failed
/// is cut; the next ones return to the size before. Source: [Gu91], [Soe].
class StepControl {
public:
  /// kinks: times at which loads are not smooth; asked_for: times at which fields are wanted [ms].
  StepControl(const StepControlOptions& options, std::vector<double> kinks,
              std::vector<double> asked_for);

  const Clock& clock() const { return clock_; }
  bool is_done() const;
  bool is_adaptive() const { return options_.is_adaptive; }
  bool is_steady_sought() const { return pseudo_time_.has_value(); }
  /// True if the steady flow is found.
  bool is_steady() const { return is_steady_sought() && pseudo_time_->is_steady(); }
  /// Size of fixed steps [ms]; zero where they are of any.
  double fixed_step() const {
    return is_adaptive() || is_steady_sought() ? 0.0 : options_.first_step;
  }
  /// A step that fails, or is not accurate enough, may be repeated.
  bool may_repeat() const { return is_adaptive() || options_.cuts > 0; }

  /// The present step has failed: cuts it. False, and it stays, where it has been cut too often.
  bool cut();
  /// The present step is too long by eta > 1: shortens it. False where it is the smallest.
  bool shorten(double eta);
  /// The present step is made, too long by eta (0: nobody knows); towards a steady flow, eta is the
  /// change over what is permitted. Plans the next.
  void advance(double eta = 0.0);

  /// State that a run needs to continue, by name; and its restoration.
  std::map<std::string, std::vector<double>> save() const;
  void restore(const std::map<std::string, std::vector<double>>& state);

private:
  void repeat_with(double size);
  void plan();
  void choose_next_size(double eta);
  double next_target() const;
  bool is_at(const std::vector<double>& times, double time) const;
  double slack() const;

  StepControlOptions options_;
  std::vector<double> kinks_, asked_for_;
  Clock clock_;
  double start_ = 0.0;  ///< of the present step
  double wanted_;       ///< size of the present step, were there no times to hit
  std::optional<PseudoTime> pseudo_time_;
  double last_eta_ = 0.0;     ///< of the step before; 0: unknown
  int whole_steps_ = 0;       ///< of fixed size, that are passed
  int cuts_ = 0;              ///< of the present step
  bool is_repeated_ = false;  ///< the present step
  struct Attempt {
    double size = 0.0, eta = 0.0;
  };
  Attempt rejected_;          ///< of the present step, the last that was too inaccurate
  bool begins_anew_ = false;  ///< behind a kink
};

/// The keys of a "Time" list.
params::Table time_table();

}  // namespace tunica::stepping
