#pragma once
#include <Teuchos_ParameterList.hpp>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "tunica/app/run_log.hpp"
#include "tunica/fields/field_mesh.hpp"
#include "tunica/problems/solid_problem.hpp"

namespace tunica::app {

/// The worst that a displacement does to the elements of a mesh: of an element, its quality
/// (mesh::quality()), how much of its own that is, and how much of its volume.
struct Deformation {
  double quality = 1.0, part_of_quality = 1.0, part_of_volume = 1.0;
};
/// d: at local nodes. Collective.
Deformation worst_deformation(const fields::FieldMesh& mesh, const std::vector<Vec3>& d);

/// Of the wall's elements that have less than 0.9 or more than 1.1 of their volume: how many of
/// all there are, the least and the largest part of its volume that one has, and the middle of the
/// worst, as it was meshed [mm].
struct VolumeChange {
  long long beyond = 0, all = 0;
  Vec3 place{};
  double least = 1.0, largest = 1.0;
};
/// geometry: where the wall is free of stress. d: displacement from the positions of its vertices,
/// at local nodes [mm]. counts: per local element, whether it does; empty: all do. Collective.
VolumeChange volume_change(const fields::FieldMesh& mesh, const assembly::ElementGeometry& geometry,
                           const std::vector<Vec3>& d, const std::vector<char>& counts = {});
/// Of the elements of layers that are nearly incompressible.
VolumeChange volume_change(const problems::SolidProblem& wall);

/// What a run says while it goes on, each thing once: a wall that does not keep its volume, flow
/// that comes back through an outlet, a lumen whose mesh is bent badly, iterations near their cap.
class Watch {
public:
  /// list: the resolved case.
  explicit Watch(const Teuchos::ParameterList& list);

  /// What is new at the end of an accepted step: a line each, with the cure. d: displacement of the
  /// fluid's mesh at its local nodes, empty where it stands still. wall: asked only where it does
  /// not keep its volume. Collective.
  std::vector<std::string> look(const StepSummary& step, double step_size,
                                const discretisation::Observables& observables,
                                const fields::FieldMesh* fluid = nullptr,
                                const std::vector<Vec3>& d = {},
                                const std::function<VolumeChange()>& wall = {});
  /// The same, said on the screen.
  void tell(const RunLog& log, const stepping::Clock& clock, const StepSummary& step,
            const discretisation::Observables& observables,
            const fields::FieldMesh* fluid = nullptr, const std::vector<Vec3>& d = {},
            const std::function<VolumeChange()>& wall = {});

private:
  void look_at_volume(const discretisation::Observables& observables,
                      const std::function<VolumeChange()>& wall);
  void look_at_outlets(const discretisation::Observables& observables, double step_size);
  void look_at_iterations(const StepSummary& step);
  void look_at_mesh(const fields::FieldMesh& mesh, const std::vector<Vec3>& d);
  void say(const std::string& kind, const std::string& line);

  bool has_nearly_incompressible_ = false;    ///< layers
  std::map<std::string, double> volume_out_;  ///< through open surfaces, listed ones bare [mm³]
  std::set<std::string> guarded_;  ///< surfaces with backflow stabilisation, or no outlets
  double largest_flow_ = 0.0;
  int most_iterations_ = 0, most_newton_ = 0;  ///< 0: there is none
  std::set<std::string> said_;
  std::vector<std::string> lines_;
};

}  // namespace tunica::app
