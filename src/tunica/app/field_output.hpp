#pragma once
#include <optional>

#include "tunica/app/run.hpp"
#include "tunica/problems/fluid_problem.hpp"
#include "tunica/problems/solid_problem.hpp"

namespace tunica::app {

/// The share of a field's mesh that this rank writes. Of the wall that is the mesh of its
/// pressures, in which vertices between layers are there once for each: values that jump can be
/// seen to.
output::Grid grid_of(const fields::FieldMesh& mesh, const std::string& name);

/// Velocity, pressure and the mesh's displacement (of all local nodes; empty: rigid) at the nodes,
/// which is called as that of the wall, so that one filter moves both.
std::vector<output::Array> fluid_arrays(const problems::FluidProblem& fluid,
                                        const std::vector<Vec3>& mesh_displacement);

/// Displacement, pressure and velocity at the nodes.
std::vector<output::Array> wall_arrays(const problems::SolidProblem& wall);
/// What the list "Output" wants of the elements: stresses; principal stresses and stretches; with
/// fibres the circumferential and the axial direction in the unloaded wall, and the fibres in the
/// deformed one, as long as they are stretched.
std::vector<output::Array> wall_cell_arrays(const problems::SolidProblem& wall,
                                            const Teuchos::ParameterList& wanted);
/// The key of that.
void add_wall_array_keys(params::Table& table);

/// The fields of one grid at one time.
struct GridFields {
  std::string grid;
  std::vector<output::Array> points, cells;
};

/// The time series of the fields, as often as the case wants them.
class FieldSeries {
public:
  /// Collective.
  FieldSeries(const RunOutput& output, const std::vector<output::Grid>& grids, const CommPtr& comm);

  bool is_due(const stepping::Clock& clock) const;
  /// Collective.
  void write(const stepping::Clock& clock, std::vector<GridFields> fields);
  /// At the end of a run. Collective.
  void finish();

private:
  int every_;
  std::optional<output::FieldWriter> writer_;
};

}  // namespace tunica::app
