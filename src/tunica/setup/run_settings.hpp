#pragma once
#include <optional>
#include <string>
#include <vector>

#include "tunica/params/table.hpp"
#include "tunica/problems/step_error.hpp"
#include "tunica/stepping/step_control.hpp"

namespace tunica::setup {

/// A resolved "Mesh" list.
struct MeshSettings {
  explicit MeshSettings(const Teuchos::ParameterList& list);

  std::string file;
  double scale;  ///< the vertices are multiplied by it
  std::string partitioner;
};
params::Table mesh_table();

/// Fields of another run with which one begins.
struct InitialState {
  std::string folder;          ///< of that run
  std::optional<double> time;  ///< [ms]; none: its last
};

/// A resolved "Time" list.
struct TimeSettings {
  explicit TimeSettings(const Teuchos::ParameterList& list);

  bool is_steady_sought() const { return steps.pseudo_time.has_value(); }

  std::string step_control;  ///< "fixed", "adaptive", "steady"
  stepping::StepControlOptions steps;
  bool hits_kinks;    ///< steps end where loads have kinks
  double wall_limit;  ///< seconds that the program may take; infinite: any
  std::optional<problems::StepTolerance> tolerance;  ///< of steps that are of any size
  std::optional<double> newton_increment;            ///< on the way to a steady flow
  std::optional<InitialState> from;                  ///< another run with which it begins
};

params::Table time_table();

/// A resolved "Output" list, which not every program has in full.
struct OutputSettings {
  explicit OutputSettings(const Teuchos::ParameterList& list);

  bool wants_fields_at_times() const { return !fields_at.empty() || fields_interval > 0.0; }
  /// The times at which it asks for the fields, up to the end of the run [ms].
  std::vector<double> times_of_fields(double end) const;

  std::string folder;
  int fields_every = 0, checkpoint_every = 0;  ///< steps; 0: never
  std::vector<double> fields_at;               ///< [ms]
  double fields_interval = 0.0;                ///< [ms]; 0: never
  int compression = 0;                         ///< of the fields
  double progress_every = 0.0;                 ///< [s]
  std::vector<std::string> surfaces;           ///< reported ones, or one of two words, see observe
  std::vector<std::string> wall_arrays;        ///< kinds
  double averages_from = 0.0;                  ///< of the wall shear stress [ms]
};
/// The keys where the case has a fluid, a wall, or both.
params::Table output_table(bool has_fluid, bool has_wall);

}  // namespace tunica::setup
