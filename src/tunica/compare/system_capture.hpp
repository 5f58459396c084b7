#pragma once
#include <functional>
#include <map>

#include "tunica/compare/linear_system.hpp"
#include "tunica/params/table.hpp"
#include "tunica/problems/watched_solver.hpp"

namespace tunica::compare {

/// Adds the keys that say which linear systems of a coupled run are wanted.
void add_capture_keys(params::Table& table);

/// Watches the linear solves of a coupled run and shows the wanted systems, each just before the
/// case's own solver gets it. That solver then carries the run on.
class SystemCapture {
public:
  using Show = std::function<void(const LinearSystem&)>;

  /// solvers: the resolved "Solvers" list.
  SystemCapture(const Teuchos::ParameterList& solvers, Show show);

  SystemCapture(const SystemCapture&) = delete;
  SystemCapture& operator=(const SystemCapture&) = delete;

  /// field: "fluid", "wall" or "system". The problem solves nothing once the capture is gone.
  void watch(const std::string& field, problems::SystemSource& problem);

  /// Sets the step and iteration that later solves belong to; both counted from 1.
  void enter(int step, int coupling_iteration);
  /// True from the end of the wanted coupling iteration on.
  bool is_complete(int step, int coupling_iteration) const;

  /// Systems shown so far.
  int count() const { return count_; }
  /// "time step 1, coupling iteration 2, all Newton steps"
  std::string wish() const;

private:
  bool is_wanted(const std::string& field, int newton_step) const;

  int wanted_step_, wanted_iteration_, wanted_newton_step_;
  std::string wanted_field_;
  Show show_;
  int step_ = 1, iteration_ = 1, count_ = 0;
  std::map<std::string, int> newton_steps_;  ///< of the present coupling iteration, by field
};

}  // namespace tunica::compare
