#pragma once
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "tunica/base/tensor.hpp"
#include "tunica/params/table.hpp"
#include "tunica/stepping/clock.hpp"

namespace tunica::stepping {

/// What a time scheme remembers of a quantity x from step to step, a vector at each local node or
/// element: the value itself, then what the scheme adds to it. Zero at the start.
class History {
public:
  /// names: of the parts behind the value, TimeScheme::remembers().
  History(std::vector<std::string> names, int n_places);

  const std::vector<Vec3>& value() const { return parts_.front(); }
  std::vector<Vec3>& value() { return parts_.front(); }

  const std::vector<std::string>& names() const { return names_; }
  /// Part k behind the value, counted from 0.
  const std::vector<Vec3>& operator[](int k) const { return parts_[k + 1]; }
  std::vector<Vec3>& operator[](int k) { return parts_[k + 1]; }

private:
  std::vector<std::string> names_;
  std::vector<std::vector<Vec3>> parts_;
};

/// How the local error of a step follows from how far its value lies from those before:
///
///   x(tⁿ) − xⁿ ≈ C (xⁿ − xᵖ),   xᵖ at tⁿ of the polynomial of degree q through the last q + 1
///
/// It falls as Δt^(q+1). C holds where the values lie on a smooth curve, as they do once a scheme
/// is on its way: a step loses c Δt^(q+1) times the derivative of order q + 1 of that curve, and
/// x − xᵖ is the same derivative times the distances of tⁿ from the q + 1 times over (q + 1)!.
struct ErrorFormula {
  int degree;       ///< q
  double constant;  ///< C
};

/// The formula of a step that loses c Δt³ times the third derivative.
ErrorFormula error_of_third_derivative(double c, const StepSizes& sizes);

/// What the new value x of a quantity makes of its time derivatives in an implicit step:
///
///   ẋ = c (x − x̃)          first derivative,    x̃ from the history
///   ρ ẍ = α x − ρ r        second derivative,   r from the history
///
///   c   rate()          1/ms         α   inertia(ρ)            kPa/mm²
///   x̃   past()          that of x    r   inertia_load()        mm/ms², where x is in mm
///
/// One scheme serves fluid, wall, mesh motion and their interface; a step may change its size.
class TimeScheme {
public:
  virtual ~TimeScheme() = default;

  /// Names of what is remembered behind the value, "velocity" first where there is one.
  virtual std::vector<std::string> remembers() const = 0;

  /// Begins the clock's present step.
  void begin_step(const Clock& clock) {
    set_step_size(clock.step_size(), clock.previous_step_size());
  }
  /// previous: that of the step before, zero where there is none [ms].
  void set_step_size(double dt, double previous = 0.0) {
    dt_ = dt;
    previous_dt_ = previous;
  }
  double step_size() const { return dt_; }                    ///< Δt [ms]
  double previous_step_size() const { return previous_dt_; }  ///< of the step before [ms]
  /// The instant at which loads act on the clock's present step [ms].
  virtual double load_time(const Clock& clock) const { return clock.time(); }

  virtual double rate() const = 0;
  virtual Vec3 past(const History& history, int place) const = 0;
  std::vector<Vec3> pasts(const History& history) const;  ///< of all places
  /// What the values before let expect at the new time, to the order of the scheme.
  virtual Vec3 prediction(const History& history, int place) const = 0;
  std::vector<Vec3> predictions(const History& history) const;  ///< of all places

  virtual double inertia(double density) const = 0;
  virtual Vec3 inertia_load(const History& history, int place) const = 0;

  /// Takes x for the value at the new time, and brings the other parts there.
  virtual void accept(const std::vector<Vec3>& x, History& history) const = 0;

  /// What it loses over a given time falls as Δt to this power.
  virtual int order() const = 0;
  /// Of the present step, in x and in the ẋ of an equation of second order.
  virtual ErrorFormula value_error(const StepSizes& sizes) const = 0;
  virtual ErrorFormula velocity_error(const StepSizes& sizes) const { return value_error(sizes); }

private:
  double dt_ = 0.0, previous_dt_ = 0.0;
};

/// A time scheme that the list of a field can name.
struct SchemeEntry {
  std::string name;
  std::string sentence;  ///< what it is good for
  bool is_for_fluids;    ///< it serves an equation of first order too
  std::string list;      ///< of its keys in the field's list; empty where it has none
  params::Table table;   ///< these keys
  /// order: of the highest derivative in the field's equations.
  std::function<std::unique_ptr<TimeScheme>(const Teuchos::ParameterList& field, int order)> make;
};

}  // namespace tunica::stepping
