#pragma once
#include <memory>

#include "tunica/fields/state.hpp"
#include "tunica/problems/following_surfaces.hpp"
#include "tunica/stepping/time_scheme.hpp"

namespace tunica::problems {

/// The fluid's mesh follows the interface: the extension of its displacement, solved for, into the
/// surfaces that follow it and then into the volume.
class MeshMotion : public fields::Restartable {
public:
  /// interface: indices of its surfaces; staying: of those that do not follow it; scheme: that of
  /// the fluid, which begins its steps. mesh and scheme must outlive the object.
  MeshMotion(const MeshMotionSettings& settings, const fields::FieldMesh& mesh,
             const std::vector<int>& interface, const std::vector<int>& staying,
             const stepping::TimeScheme& scheme);

  /// Sets displacement() from that of the owned interface nodes (other entries are ignored).
  /// Says why where the linear solver fails. Collective.
  Outcome extend(const std::vector<Vec3>& interface_displacement,
                 const ExtensionAccuracy& accuracy = {});

  /// The next extend() begins with the polynomial of the degree through the last steps at the end
  /// of the present one, which is the extension of an interface that is guessed in the same way.
  void begin_extrapolated(int degree, const stepping::StepSizes& sizes);

  /// Increment of the owned nodes for an increment of the interface's displacement, solved to a
  /// relative residual; other entries of the given increment are ignored. Collective.
  void extend_increment(double tolerance, const Vector& interface, Vector& d);

  const std::vector<Vec3>& displacement() const { return d_; }  ///< local nodes
  /// Displacement of the last step.
  std::vector<Vec3> old_displacement() const { return fields::as_vectors(timeline_.value()); }
  /// The time scheme's past of the displacement in the present step.
  std::vector<Vec3> past_displacement() const {
    return fields::as_vectors(scheme_->pasts(timeline_));
  }
  /// Displacement extrapolated from earlier steps to the end of the present step.
  std::vector<Vec3> predicted_displacement() const {
    return fields::as_vectors(scheme_->predictions(timeline_));
  }
  /// The mesh lies at the start where the interface is displaced like this. See extend().
  Outcome start_from(const std::vector<Vec3>& interface_displacement);
  void end_step() { scheme_->accept(fields::as_rows(d_), timeline_); }

  // Restartable
  fields::State save() const override;
  std::string restore(const fields::State& state) override;

private:
  void begin_with(const stepping::Rows& local);

  const fields::FieldMesh* mesh_;
  std::vector<char> is_interface_;  ///< per owned node
  FollowingSurfaces surfaces_;
  LawExtension volume_;
  const stepping::TimeScheme* scheme_;
  stepping::Timeline timeline_;
  std::vector<Vec3> d_;
};

params::Table mesh_motion_table();

}  // namespace tunica::problems
