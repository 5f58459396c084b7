#pragma once
#include <vector>

#include "tunica/base/pack.hpp"
#include "tunica/base/tensor.hpp"
#include "tunica/materials/frame.hpp"

namespace tunica::materials {

/// Stress and tangent of a hyperelastic law at one point.
template <class Real>
struct StressTangentOf {
  Sym3Of<Real> S;     ///< second Piola–Kirchhoff stress S' = 2 ∂Ψ'/∂C [kPa]
  Sym3MapOf<Real> D;  ///< D[I][J] = dS_I / dE_J with E = (C − I)/2 and engineering shears
                      ///< (E_J = 2 E_xy for J = xy): maps Voigt strain to Voigt stress [kPa],
                      ///< symmetric
};
using StressTangent = StressTangentOf<double>;

/// Isochoric part of a hyperelastic law, as the mixed displacement–pressure solid sees it.
///
/// The volumetric part κ/2 (J − 1)² is not here: the pressure field carries it
/// (kernels/solid_up.hpp). A law with another one has the difference in Ψ'.
/// Every law is a value without hidden state; one object serves all elements. Tensors live
/// in the reference frame; C is the right Cauchy–Green tensor FᵀF. Where a law does not permit
/// a deformation it returns values that are not finite, so that Newton steps back.
class HyperelasticLaw {
public:
  virtual ~HyperelasticLaw() = default;

  /// Energy Ψ'(C) per reference volume [kPa]; zero at C = I.
  virtual double energy(const Sym3& C, const Frame& frame) const = 0;

  /// S'(C) = 2 ∂Ψ'/∂C [kPa].
  virtual Sym3 stress(const Sym3& C, const Frame& frame) const = 0;

  /// S'(C) and its tangent.
  virtual StressTangent response(const Sym3& C, const Frame& frame) const = 0;

  /// The same at the points of a pack. Here point by point: a law overrides them to be fast.
  virtual Sym3Of<Pack> packed_stress(const Sym3Of<Pack>& C, const FrameOf<Pack>& frame) const;
  virtual StressTangentOf<Pack> packed_response(const Sym3Of<Pack>& C,
                                                const FrameOf<Pack>& frame) const;

  /// The modulus μ_l of the paper, 2(c10 + c01) for Mooney–Rivlin [kPa]; scales the PSPG τ.
  virtual double stabilisation_modulus() const = 0;

  /// True where the frame matters.
  virtual bool has_fibres() const { return false; }

  /// Unit vectors along the families of fibres, in the reference configuration.
  virtual std::vector<Vec3> fibre_directions(const Frame&) const { return {}; }
};

}  // namespace tunica::materials
