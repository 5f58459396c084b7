#pragma once
#include "tunica/fields/state.hpp"
#include "tunica/nonlinear/newton.hpp"

namespace tunica::coupling {

/// Whether the Jacobians of a step have shape derivatives, that is, know how the fluid's domain
/// follows the wall, where this is to be found out. The answer is the same either way. With them
/// Newton's method takes half the steps in a vessel that is bent, and as many as without in a
/// straight tube; but each product with the Jacobian then moves the mesh. The work of a step is
/// counted in iterations without them: of n Newton steps with m_k Krylov iterations
///
///   W = c n + (1 + s) Σ_k m_k + a,   s = a = 0 without shape derivatives.
///
/// The rule goes one way, tries the other for two steps every so often, and takes that if they need
/// less than the two before, clearly less where it is the one with derivatives. As long as its way
/// wins it tries half as often each time. It begins without. A solve without them goes over to them
/// where it takes many Newton steps; the rule then tries them at once, and a trial without them is
/// over. There is no clock in it: runs can be repeated, and ranks agree.
class GeometryRule {
public:
  bool wants_derivatives() const { return present_ != is_trial(); }

  /// Newton steps that a solve may need without derivatives. It goes over to them, which nearly
  /// always halve so many, as soon as its pace is too slow for that.
  static constexpr int most_without = 8;

  /// A step was solved in the way that it wants, or has gone over to derivatives.
  void note(const nonlinear::NewtonReport& report, bool has_gone_over);
  /// A step could not be solved so.
  void note_failure();

  void save(fields::State& state) const;
  void restore(const fields::State& state);

private:
  bool is_trial() const { return steps_ >= wait_; }
  void go(bool has_derivatives, int wait);

  static constexpr int first_wait = 4;

  bool present_ = false;              ///< the way it goes has derivatives
  int wait_ = first_wait;             ///< steps on it until the other one is tried
  int steps_ = 0;                     ///< since it goes it, or since the last trial
  double rival_ = 0.0;                ///< W of the two steps before a trial
  double before_ = 0.0, last_ = 0.0;  ///< W of the last two steps
};

}  // namespace tunica::coupling
