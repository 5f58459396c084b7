#pragma once
#include "tunica/fields/state.hpp"
#include "tunica/problems/harmonic.hpp"

namespace tunica::problems {

/// The fluid's mesh follows the interface: the harmonic extension of its displacement, solved for.
class MeshMotion : public fields::Restartable {
public:
  /// list: the resolved "Mesh Motion" list; surfaces: indices of the interface's surfaces.
  MeshMotion(const Teuchos::ParameterList& list, const fields::FieldMesh& mesh,
             const std::vector<int>& surfaces);

  /// Sets displacement() from that of the owned interface nodes (other entries are ignored).
  /// Says why where the linear solver fails. Collective.
  Outcome extend(const std::vector<Vec3>& interface_displacement);

  const std::vector<Vec3>& displacement() const { return d_; }          ///< local nodes
  const std::vector<Vec3>& old_displacement() const { return d_old_; }  ///< of the last step
  void end_step() { d_old_ = d_; }

  // Restartable
  fields::State save() const override;
  std::string restore(const fields::State& state) override;

private:
  const fields::FieldMesh* mesh_;
  std::vector<char> is_interface_;  ///< per owned node
  discretisation::MeshMotion motion_;
  Harmonic harmonic_;
  std::vector<Vec3> d_, d_old_;
};

params::Table mesh_motion_table();

}  // namespace tunica::problems
