#pragma once
#include <memory>
#include <string>
#include <vector>

#include "tunica/base/outcome.hpp"
#include "tunica/observe/field.hpp"
#include "tunica/run/domain.hpp"
#include "tunica/run/run_output.hpp"

namespace tunica::run {

/// A case on its domain, taken through time: a fluid, a wall, or both coupled.
///
///   run::Simulation simulation(the_case, domain, output);
///   Outcome outcome = simulation.begin();
///   while (outcome.is_success() && !simulation.is_done()) outcome = simulation.step();
///   return outcome.is_success() ? simulation.finish() : outcome;
///
/// Several may live in one process, one after the other or side by side, each with an output of its
/// own. All calls are collective over the ranks of the domain.
class Simulation {
public:
  /// the_case: see setup::read_case(). domain and output must outlive the object.
  /// Throws Error where the case cannot be solved on the domain.
  Simulation(const setup::Case& the_case, const Domain& domain, RunOutput& output);
  ~Simulation();

  /// The state before the first step: the prestress of a wall is found, or the newest checkpoint is
  /// taken where the run goes on, and the files of the run are opened. Fails where there is no
  /// prestress. Throws Error where the checkpoint lacks something.
  Outcome begin();

  /// All steps are made, or the run ends before: by a signal, or by the clock on the wall.
  bool is_done() const;

  /// Makes the next step: it is solved, with cuts and repeats as the case says, enters the tables,
  /// and leaves fields and a checkpoint where they are due. Fails where it is not accepted; the
  /// last step before it is then a checkpoint, as where an exception ends the step that all ranks
  /// meet alike. Throws MachineFault on all ranks if the disk refuses a checkpoint.
  Outcome step();

  /// Closes the files. Fails where a steady flow was sought and not found.
  Outcome finish();

  /// begin(), step() until is_done(), finish().
  Outcome march();

  /// Number and time of the last step; before the first step, those of the state that the run
  /// continues from.
  int steps_made() const;
  double time() const;  ///< [ms]
  /// Columns of the fields in the row of the last step in steps.csv.
  const discretisation::Observables& observed() const;

  /// "wall", "fluid", and the names in the list "Fields"; from begin() on.
  std::vector<std::string> field_names() const;
  /// Throws Error, with the names there are, where the case has no such field.
  observe::Field& field(const std::string& name) const;

private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace tunica::run
