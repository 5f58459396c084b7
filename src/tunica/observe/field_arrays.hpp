#pragma once
#include "tunica/output/field_writer.hpp"
#include "tunica/params/table.hpp"
#include "tunica/problems/fluid_problem.hpp"
#include "tunica/problems/stress_recovery.hpp"

namespace tunica::observe {

/// The share of a field's mesh that this rank writes. Of the wall that is a mesh in which vertices
/// between layers are there once for each: values that jump can be seen to.
output::Grid grid_of(const fields::FieldMesh& mesh, const std::string& name);

/// Velocity, pressure and the mesh's displacement (of all local nodes; empty: rigid) at the nodes,
/// which is called as that of the wall, so that one filter moves both.
std::vector<output::Array> fluid_arrays(const problems::FluidProblem& fluid,
                                        const std::vector<Vec3>& mesh_displacement);

/// The fields of one grid at one time.
struct GridFields {
  std::string grid;
  std::vector<output::Array> points, cells;
};

/// What fields.h5 has of the wall. At nodes: displacement, pressure, velocity, and what of the
/// following needs stress alone, as it is recovered from the elements around. Of elements, as the
/// list "Output" wants it: stresses; principal stresses and stretches; with fibres the
/// circumferential and the axial direction in the unloaded wall, and the fibres in the deformed
/// one, as long as they are stretched; and how far their stress is from that at the nodes.
class WallOutput {
public:
  /// wall must outlive the object. Collective.
  WallOutput(const problems::SolidProblem& wall, const Teuchos::ParameterList& output);

  output::Grid grid() const { return grid_of(recovery_.mesh(), "wall"); }
  /// Of the wall's present state. Collective.
  GridFields fields() const;

private:
  bool has(const std::string& kind) const;
  std::vector<output::Array> node_arrays() const;
  std::vector<output::Array> cell_arrays() const;
  void add_recovered(const problems::NodalStress& nodal, GridFields& fields) const;

  const problems::SolidProblem* wall_;
  problems::StressRecovery recovery_;
  std::vector<std::string> kinds_;
};
/// The key of what it writes.
void add_wall_array_keys(params::Table& table);

}  // namespace tunica::observe
