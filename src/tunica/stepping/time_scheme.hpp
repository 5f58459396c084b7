#pragma once
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "tunica/params/table.hpp"
#include "tunica/stepping/clock.hpp"
#include "tunica/stepping/timeline.hpp"

namespace tunica::stepping {

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

/// Time derivatives of a quantity as functions of its new value x in an implicit step:
///
///   ẋ = c (x − x̃)          first derivative,    x̃ from the history
///   ρ ẍ = α x − ρ r        second derivative,   r from the history
///
///   c   rate()          1/ms         α   inertia(ρ)            kPa/mm²
///   x̃   past()          that of x    r   inertia_load()        mm/ms², where x is in mm
///
/// One scheme serves fluid, wall, mesh motion and their interface; a step may change its size. It
/// acts on each number of a timeline by itself: i is that of an entry of its rows.
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
  virtual double past(const Timeline& x, int i) const = 0;
  Rows pasts(const Timeline& x) const;  ///< of all entries
  /// Extrapolation of earlier values to the new time, at the order of the scheme.
  virtual double prediction(const Timeline& x, int i) const = 0;
  Rows predictions(const Timeline& x) const;  ///< of all entries

  virtual double inertia(double density) const = 0;
  virtual double inertia_load(const Timeline& x, int i) const = 0;
  Rows inertia_loads(const Timeline& x) const;  ///< of all entries

  /// Takes `now` for the value at the new time, and brings what is remembered beside it there.
  virtual void accept(Rows now, Timeline& x) const = 0;

  /// Order: the error over a given time decreases as Δt to this power.
  virtual int order() const = 0;
  /// Error formulas of the present step, for x and for ẋ of an equation of second order.
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
