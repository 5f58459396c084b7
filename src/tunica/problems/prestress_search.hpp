#pragma once
#include <memory>
#include <optional>

#include "tunica/problems/prestress.hpp"
#include "tunica/problems/prestress_balance.hpp"
#include "tunica/problems/prestress_method.hpp"

namespace tunica::problems {

/// The way from no load to all of it.
class PrestressSearch {
public:
  /// The arguments must outlive the object.
  PrestressSearch(const SolidSettings& settings, const SolidProblem& wall,
                  const PrestressWatch& watch, const PrestressPoint& from);
  Result<Prestress> run();

private:
  /// Why a load was given up; what the answer depends on.
  enum class Cause { none, linear_solver, nonlinear, creeps, cap, stopped };
  struct Verdict {
    Cause cause = Cause::none;
    std::string reason{};
    double load = 1.0;
  };

  Verdict raise_loads();
  bool can_lean() const;
  bool may_lean(const Verdict& verdict) const;
  Verdict lean(const Verdict& verdict);
  void begin_to_lean(const Prestress& start, double load);
  Verdict release();
  Verdict release_once(double left);
  bool goes_on() const;
  TissueHold held_by_tissue() const;
  Verdict bear(double load);
  Verdict iterate(PrestressIteration& now);
  Verdict improve(PrestressIteration& now);
  /// Takes the step, and that part of the pressure's, where less is out of balance then than
  /// before.
  bool try_step(const std::vector<Vec3>& s, const algebra::BlockVector& dx, double part,
                double before, PrestressIteration& now);
  Prestress copy_of(const Prestress& point) const;
  void go_back_to(const Prestress& point);
  /// Into the wall in balance.
  Outcome put(const std::vector<Mat3>& prestretch, const std::vector<Vec3>& offset);
  void note_prestretch(PrestressIteration& now) const;
  std::string failure(const Verdict& verdict) const;
  std::string most_stretched() const;
  const Comm& comm() const { return *wall_->mesh().comm; }

  PrestressOptions options_;
  const SolidSettings* settings_;
  const SolidProblem* wall_;
  const PrestressWatch* watch_;
  std::unique_ptr<PrestressBalance> balance_;
  std::unique_ptr<PrestressMethod> method_;
  Prestress found_;
  PrestressPoint point_;
  /// Where a release has begun, in balance; empty without one. A search that is stopped within it
  /// goes on there.
  struct Balanced {
    Prestress state;
    PrestressPoint point;
  };
  std::optional<Balanced> balanced_;
  std::string refusal_;  ///< why the last step was not taken
  double goal_;          ///< how far the wall may be off the mesh [mm]
  int iterations_ = 0;   ///< at the last load
};

}  // namespace tunica::problems
