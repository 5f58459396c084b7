#pragma once
#include <memory>

#include "tunica/discretisation/discretisation.hpp"
#include "tunica/discretisation/extension.hpp"

namespace tunica::discretisation {

/// How the fluid's mesh follows its boundary.
struct MotionLaw {
  bool is_elastic = false;  ///< else harmonic
  double poisson = 0.3;     ///< of an elastic one
  double stiffening = 0.0;
};

/// Extension of the displacement of the fluid's boundary into its mesh, harmonic ([LY1] eq:harext)
/// or elastic.
class MeshMotion final : public Discretisation {
public:
  /// mesh must outlive the object. Collective.
  explicit MeshMotion(const fields::FieldMesh& mesh, const MotionLaw& law = {});

  /// All nodes of surfaces are given. Of the two that there are one is null.
  const HarmonicExtension* harmonic() const { return harmonic_.get(); }
  const ElasticExtension* elastic() const { return elastic_.get(); }

  // Discretisation: one block, the displacement of the mesh
  const algebra::BlockSpacePtr& space() const override { return space_; }
  /// x has the given displacements at the nodes of surfaces.
  Outcome residual(const algebra::BlockVector& x, algebra::BlockVector& F) override;
  void assemble_jacobian(const algebra::BlockVector& x) override;
  const algebra::BlockMatrix& jacobian() const override { return K_; }
  double mass_norm(const algebra::BlockVector& dx) const override;

private:
  const Extension& extension() const;

  const fields::FieldMesh* mesh_;
  std::unique_ptr<HarmonicExtension> harmonic_;
  std::unique_ptr<ElasticExtension> elastic_;
  algebra::BlockSpacePtr space_;
  algebra::BlockMatrix K_;  ///< made when it is first asked for, and the same ever after
};

}  // namespace tunica::discretisation
