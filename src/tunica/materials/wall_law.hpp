#pragma once
#include <array>
#include <vector>

#include "tunica/base/pack.hpp"
#include "tunica/base/tensor.hpp"
#include "tunica/materials/frame.hpp"

namespace tunica::materials {

/// Stress and tangent of a law at one point.
template <class Real>
struct StressTangentOf {
  Sym3Of<Real> S;     ///< second Piola–Kirchhoff stress S' [kPa]
  Sym3MapOf<Real> D;  ///< D[I][J] = dS_I / dE_J with E = (C − I)/2 and engineering shears
                      ///< (E_J = 2 E_xy for J = xy): maps Voigt strain to Voigt stress [kPa],
                      ///< symmetric
};
using StressTangent = StressTangentOf<double>;

/// History of a law at a point, and the time step that starts from it.
struct Past {
  const double* state = nullptr;  ///< WallLaw::state_width() numbers
  double step = 0.0;              ///< Δt [ms]; 0: in equilibrium, where the past has faded
};
using PackedPast = std::array<Past, Pack::size>;

/// Isochoric part of a wall's law, as the mixed displacement–pressure solid sees it.
///
/// The volumetric part κ/2 (J − 1)² is not here: the pressure field carries it
/// (kernels/solid_up.hpp). One object serves all elements: what a law remembers is kept by the
/// field, and handed to it. Tensors live in the reference frame; C is the right Cauchy–Green tensor
/// FᵀF. Where a law does not permit a deformation it returns values that are not finite, so that
/// Newton steps back.
class WallLaw {
public:
  virtual ~WallLaw() = default;

  /// Numbers that the law remembers at a point, zero at the start.
  virtual int state_width() const { return 0; }

  /// Energy that is stored elastically, per reference volume [kPa]; zero at C = I.
  virtual double energy(const Sym3& C, const Frame& frame, const Past& past) const = 0;
  /// S' at the end of the step [kPa].
  virtual Sym3 stress(const Sym3& C, const Frame& frame, const Past& past) const = 0;
  /// S' and its tangent.
  virtual StressTangent response(const Sym3& C, const Frame& frame, const Past& past) const = 0;

  /// Stress and response at the points of a pack. The default is point by point; a law may override
  /// them for speed.
  virtual Sym3Of<Pack> packed_stress(const Sym3Of<Pack>& C, const FrameOf<Pack>& frame,
                                     const PackedPast& past) const;
  virtual StressTangentOf<Pack> packed_response(const Sym3Of<Pack>& C, const FrameOf<Pack>& frame,
                                                const PackedPast& past) const;

  /// Stores the history of a step that has ended at C; state has room for state_width() numbers.
  virtual void remember(const Sym3& /*C*/, const Frame&, const Past&, double* /*state*/) const {}

  /// The modulus μ_l of the paper, 2(c10 + c01) for Mooney–Rivlin [kPa]; scales the PSPG τ.
  virtual double stabilisation_modulus() const = 0;

  /// True where the frame matters.
  virtual bool has_fibres() const { return false; }

  /// Unit vectors along the families of fibres, in the reference configuration.
  virtual std::vector<Vec3> fibre_directions(const Frame&) const { return {}; }
};

}  // namespace tunica::materials
