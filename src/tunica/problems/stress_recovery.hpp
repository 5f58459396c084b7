#pragma once
#include <array>
#include <memory>

#include "tunica/assembly/patch_recovery.hpp"
#include "tunica/fields/split_mesh.hpp"
#include "tunica/problems/solid_problem.hpp"

namespace tunica::problems {

/// Cauchy stress of a wall at its nodes, and how far that of the elements is from it.
struct NodalStress {
  std::vector<Sym3> stress;  ///< per owned node [kPa]
  /// Unit vectors along the deformed fibres, per family and owned node; zero where a layer has
  /// none, empty where the wall has none.
  std::array<std::vector<Vec3>, 2> fibres;
  /// Per local element, those of other ranks as well: (1/V ∫ |σ* − σ|² dV)^½ [kPa], σ* linear
  /// between the nodes, |σ|² = σ : σ, V of the mesh. Source: [ZZ87].
  std::vector<double> error;
};

/// The stress of a wall at its nodes by assembly::PatchRecovery, each layer for itself: vertices
/// between layers have a node for each. The pressures enter as the means of elements, as they do in
/// the elements' stress.
class StressRecovery {
public:
  /// wall must outlive the object. Collective.
  explicit StressRecovery(const SolidProblem& wall);

  /// Where the values stand: the mesh of the wall's pressures where these jump between layers.
  const fields::FieldMesh& mesh() const { return patches_->mesh(); }
  /// That mesh where it is split, else null.
  const fields::SplitMesh* split() const { return own_split_ ? own_split_.get() : wall_->split(); }

  /// Nodal stress of the wall's present state. Collective.
  NodalStress recover() const;

private:
  const SolidProblem* wall_;
  std::unique_ptr<fields::SplitMesh> own_split_;
  std::unique_ptr<assembly::PatchRecovery> patches_;
};

}  // namespace tunica::problems
