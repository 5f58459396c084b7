#pragma once
#include "tunica/discretisation/discretisation.hpp"
#include "tunica/fields/block_operator.hpp"

namespace tunica::discretisation {

/// Where a function is harmonic: in the volume of a field, within the surfaces that bound it, or
/// along the lines in which two of these meet.
enum class Extent { volume, surfaces, lines };

/// Harmonic functions on the undeformed mesh of a field:
///
///   −∇·(γ ∇φ) = 0,  φ given at some nodes, no flux through the rest of the boundary
///
/// γ = (V̄/V)^χ of an element of volume V (area, length), V̄ the mean: with χ > 0 small elements
/// are stiffer than large ones. Components of a vector do not see each other.
class HarmonicExtension {
public:
  /// is_given: one flag per local node; of surfaces and lines, those of all other nodes too.
  /// stiffening: χ. mesh must outlive the object. Collective.
  HarmonicExtension(const fields::FieldMesh& mesh, std::vector<char> is_given,
                    Extent extent = Extent::volume, double stiffening = 0.0);

  const fields::FieldMesh& mesh() const { return *mesh_; }
  bool is_given(int node) const { return is_given_[node]; }
  /// F = L φ at the other nodes, zero at the given ones; one function per column. Collective.
  void residual(const MultiVector& phi, MultiVector& F) const;
  /// L; rows and columns of given nodes keep their diagonal only.
  const Teuchos::RCP<CrsMatrix>& jacobian() const { return jacobian_; }

private:
  const fields::FieldMesh* mesh_;
  std::vector<char> is_given_;
  Teuchos::RCP<CrsMatrix> jacobian_, laplacian_;  ///< the latter without conditions
};

/// Harmonic extension of the displacement of the fluid's boundary into its mesh ([LY1] eq:harext).
class MeshMotion final : public Discretisation {
public:
  /// stiffening: see HarmonicExtension. mesh must outlive the object. Collective.
  explicit MeshMotion(const fields::FieldMesh& mesh, double stiffening = 0.0);

  const HarmonicExtension& extension() const { return extension_; }

  // Discretisation: one block, the displacement of the mesh
  const algebra::BlockSpacePtr& space() const override { return space_; }
  /// x has the given displacements at the nodes of surfaces.
  Outcome residual(const algebra::BlockVector& x, algebra::BlockVector& F) override;
  void assemble_jacobian(const algebra::BlockVector& x) override;
  const algebra::BlockMatrix& jacobian() const override { return K_; }
  double mass_norm(const algebra::BlockVector& dx) const override;

private:
  HarmonicExtension extension_;
  algebra::BlockSpacePtr space_;
  algebra::BlockMatrix K_;  ///< made when it is first asked for, and the same ever after
};

}  // namespace tunica::discretisation
