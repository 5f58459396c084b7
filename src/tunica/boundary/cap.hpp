#pragma once
#include <array>
#include <complex>
#include <vector>

#include "tunica/boundary/boundary_term.hpp"

namespace tunica::boundary {

/// The triangles of a whole surface on every rank, the same and in the same order on any number of
/// them: for the small problems that are posed on an inlet.
struct Cap {
  std::vector<int> vertex;   ///< numbers in the mesh, ascending
  std::vector<Vec3> x;       ///< undeformed [mm]
  std::vector<char> is_rim;  ///< it lies on another surface too, where the section ends
  std::vector<std::array<int, 3>> triangles;

  int n_nodes() const { return static_cast<int>(vertex.size()); }
  /// Place of a vertex; -1 where it does not lie on the cap.
  int find(int vertex_number) const;
};

/// planes: surfaces of symmetry, beyond which the section goes on: they make no rim. Collective.
Cap gather_cap(const fields::FieldMesh& mesh, int surface, const std::vector<int>& planes = {});

/// A term that makes a profile of what the mesh has of a section.
class SectionProfile : public virtual BoundaryTerm {
public:
  virtual int surface() const = 0;
  /// Comes once, before all that follows. planes: see gather_cap(). Collective.
  virtual void make_profile(const std::vector<int>& planes) = 0;
};

/// ∫ f dA, f linear on each triangle.
double integral(const Cap& cap, const std::vector<double>& f);

/// A profile at the nodes of a cap, with ∫ φ dA = 1 [1/mm²].
using Profile = std::vector<double>;
using ComplexProfile = std::vector<std::complex<double>>;

/// The uniform profile, zero at the rim.
Profile flat_profile(const Cap& cap);

/// The profile of steady flow along the normal in a long pipe of this section, of any shape:
///
///   −Δφ = const,   φ = 0 on the rim,   ∂φ/∂n = 0 on planes of symmetry
///
/// A paraboloid on a disc or a part of it, a parabola between parallel walls.
Profile harmonic_profile(const Cap& cap);

/// The profile of a flow that oscillates as e^{iωt}:
///
///   iω φ − ν Δφ = const,   φ = 0 on the rim,   ∂φ/∂n = 0 on planes of symmetry
///
///   ω  angular frequency, positive   1/ms     ν  kinematic viscosity   mm²/ms
///
/// Womersley's profile on a disc. Throws Error where no node lies within the rim, as the others.
ComplexProfile womersley_profile(const Cap& cap, double omega, double nu);

}  // namespace tunica::boundary
