#pragma once
#include <Teuchos_ParameterList.hpp>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "tunica/fields/field_mesh.hpp"
#include "tunica/judge/volume.hpp"
#include "tunica/run/run_log.hpp"
#include "tunica/setup/case.hpp"

namespace tunica::run {

/// The worst that a displacement does to the elements of a mesh: of an element, its quality
/// (mesh::quality()), how much of its own that is, and how much of its volume.
struct Deformation {
  double quality = 1.0, part_of_quality = 1.0, part_of_volume = 1.0;
};
/// d: at local nodes. Collective.
Deformation worst_deformation(const fields::FieldMesh& mesh, const std::vector<Vec3>& d);

/// Warnings of a run, each given once: a wall that does not keep its volume, flow that returns
/// through an outlet, a badly deformed mesh of the lumen, iterations near their cap.
class Watch {
public:
  explicit Watch(const setup::Case& the_case);

  /// New warnings at the end of an accepted step: a line each, with the cure. d: displacement of
  /// the fluid's mesh at its local nodes, empty where it stands still. wall: asked only where it
  /// does not keep its volume. Collective.
  std::vector<std::string> look(const StepSummary& step, double step_size,
                                const discretisation::Observables& observables,
                                const fields::FieldMesh* fluid = nullptr,
                                const std::vector<Vec3>& d = {},
                                const std::function<std::vector<judge::LayerVolume>()>& wall = {});
  /// Prints the new warnings on the screen.
  void tell(const RunLog& log, const stepping::Clock& clock, const StepSummary& step,
            const discretisation::Observables& observables,
            const fields::FieldMesh* fluid = nullptr, const std::vector<Vec3>& d = {},
            const std::function<std::vector<judge::LayerVolume>()>& wall = {});

private:
  void look_at_volume(const discretisation::Observables& observables,
                      const std::function<std::vector<judge::LayerVolume>()>& wall);
  void look_at_outlets(const discretisation::Observables& observables, double step_size);
  void look_at_iterations(const StepSummary& step);
  void look_at_mesh(const fields::FieldMesh& mesh, const std::vector<Vec3>& d);
  void say(const std::string& kind, const std::string& line);

  bool has_nearly_incompressible_ = false;    ///< layers
  std::map<std::string, double> volume_out_;  ///< through open surfaces, listed ones bare [mm³]
  std::set<std::string> guarded_;  ///< surfaces with backflow stabilisation, or no outlets
  double largest_flow_ = 0.0;
  int most_iterations_ = 0, most_newton_ = 0;  ///< 0: there is none
  std::string mesh_cures_;                     ///< settings not made that keep the mesh in shape
  std::set<std::string> said_;
  std::vector<std::string> lines_;
};

}  // namespace tunica::run
