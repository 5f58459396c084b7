#pragma once
#include <set>

#include "tunica/fields/block_operator.hpp"

namespace tunica::discretisation {

/// Where a function is harmonic: in the volume of a field, within the surfaces that bound it, or
/// along the lines in which two of these meet.
enum class Extent { volume, surfaces, lines };

/// Local nodes, the lower one first.
using Edge = std::array<int, 2>;
using Edges = std::set<Edge>;
/// From corner k of a face to the next.
Edge edge_of(const fields::Face& face, int k);
/// The edges of the boundary in which two surfaces meet: all that have an owned node.
Edges edges_of_lines(const fields::FieldMesh& mesh);

/// Functions on the undeformed mesh of a field that are given at some nodes and solve a linear
/// equation at the others, with no flux through the rest of the boundary. γ = (V̄/V)^χ of an element
/// of volume V, or of a face of area A with A^3/2 for it, or of an edge of length h with h³; V̄ is
/// the mean of all. With χ > 0, the stiffening, small elements are stiffer than large ones.
class Extension {
public:
  virtual ~Extension() = default;
  const fields::FieldMesh& mesh() const { return *mesh_; }
  bool is_given(int node) const { return is_given_[node]; }
  /// F = L φ at the other nodes, zero at the given ones. φ and F have a row for each owned node.
  /// Collective.
  virtual void residual(const MultiVector& phi, MultiVector& F) const = 0;

protected:
  /// is_given: one flag per local node. mesh must outlive the object.
  Extension(const fields::FieldMesh& mesh, std::vector<char> is_given)
      : mesh_(&mesh), is_given_(std::move(is_given)) {}
  void drop_given(MultiVector& F) const;

  const fields::FieldMesh* mesh_;
  std::vector<char> is_given_;
};

/// −∇·(γ ∇φ) = 0, one function per column: components of a vector do not see each other.
class HarmonicExtension final : public Extension {
public:
  /// is_given: of surfaces and lines, all other nodes are given too. Collective.
  HarmonicExtension(const fields::FieldMesh& mesh, std::vector<char> is_given,
                    Extent extent = Extent::volume, double stiffening = 0.0);

  void residual(const MultiVector& phi, MultiVector& F) const override;
  /// L; rows and columns of given nodes keep their diagonal only.
  const Teuchos::RCP<CrsMatrix>& jacobian() const { return jacobian_; }

private:
  Teuchos::RCP<CrsMatrix> jacobian_, laplacian_;  ///< the latter without conditions
};

/// A linear elastic body of modulus γ that is nowhere loaded within:
///
///   −∇·(γ σ) = 0,  σ = 2 μ ε(d) + λ (∇·d) I,  μ = 1/(2(1 + ν)),  λ = ν/((1 + ν)(1 − 2ν))
///
/// φ has three columns, the components of d [mm]. In surfaces ε and ∇ are those within them, and
/// displacements across them are harmonic, −∇·(γ μ ∇d_n) = 0, where they are plane.
class ElasticExtension final : public Extension {
public:
  /// is_given: of surfaces, all other nodes are given too; extent: not lines, which do not shear;
  /// poisson: ν, below 0.5. Collective.
  ElasticExtension(const fields::FieldMesh& mesh, std::vector<char> is_given, Extent extent,
                   double poisson, double stiffening);

  void residual(const MultiVector& phi, MultiVector& F) const override;
  /// L on the three unknowns of each node, without conditions.
  const Teuchos::RCP<CrsMatrix>& matrix() const { return matrix_; }
  /// With the same γ and the same given nodes. Where the whole boundary is given and γ is constant,
  /// L is between μ and 2 μ + λ times as stiff (Korn).
  const HarmonicExtension& harmonic() const { return harmonic_; }

private:
  template <std::size_t n>
  void add(const std::array<int, n>& nodes,
           const std::array<std::array<double, 3 * n>, 3 * n>& element);

  HarmonicExtension harmonic_;
  Teuchos::RCP<CrsMatrix> matrix_;
};

}  // namespace tunica::discretisation
