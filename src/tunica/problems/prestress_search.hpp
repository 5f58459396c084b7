#pragma once
#include <memory>

#include "tunica/problems/prestress.hpp"
#include "tunica/problems/prestress_balance.hpp"

namespace tunica::problems {

/// Effect of the search steps in one method.
class PrestressMethod {
public:
  virtual ~PrestressMethod() = default;
  /// The prestretch after a step s, on owned nodes, from the present one. Collective.
  virtual std::vector<Mat3> prestretch_after(const std::vector<Vec3>& s,
                                             const std::vector<Mat3>& present) = 0;
  /// The last one stays.
  virtual void keep() {}
  /// A load step begins; or it was given up, and all goes back to where it began.
  virtual void begin_load() {}
  virtual void undo_load() {}
  /// PrestressPoint::shape, and back.
  virtual std::vector<Vec3> shape() const { return {}; }
  virtual void start_from(const std::vector<Vec3>& /*shape*/) {}
};

/// The way from no load to all of it.
class PrestressSearch {
public:
  /// The arguments must outlive the object.
  PrestressSearch(const SolidSettings& settings, const SolidProblem& wall,
                  const PrestressWatch& watch, const PrestressPoint& from);
  Result<Prestress> run();

private:
  /// Why a load was given up; what the answer depends on.
  enum class Cause { none, linear_solver, nonlinear, creeps, stopped };
  struct Verdict {
    Cause cause = Cause::none;
    std::string reason{};
  };

  Verdict bear(double load);
  Verdict iterate(PrestressIteration& now);
  Verdict improve(PrestressIteration& now);
  /// Takes the step, and that part of the pressure's, where less is out of balance then than
  /// before.
  bool try_step(const std::vector<Vec3>& s, const algebra::BlockVector& dx, double part,
                double before, PrestressIteration& now);
  void go_back_to(const Prestress& point);
  void note_prestretch(PrestressIteration& now) const;
  std::string failure(double load, const Verdict& verdict) const;
  std::string most_stretched() const;
  const Comm& comm() const { return *wall_->mesh().comm; }

  PrestressOptions options_;
  const SolidProblem* wall_;
  const PrestressWatch* watch_;
  PrestressBalance balance_;
  std::unique_ptr<PrestressMethod> method_;
  Prestress found_;
  PrestressPoint point_;
  std::string refusal_;  ///< why the last step was not taken
  double goal_;          ///< how far the wall may be off the mesh [mm]
  int iterations_ = 0;   ///< at the last load
};

}  // namespace tunica::problems
