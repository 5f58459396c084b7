#pragma once

namespace tunica::materials {

/// A dynamic viscosity, and how it changes with the shear rate.
template <class Real>
struct ViscosityOf {
  Real value;  ///< μ [kPa ms]
  Real slope;  ///< dμ/d(γ̇²) [kPa ms³]
};
using Viscosity = ViscosityOf<double>;

/// The law of a generalised Newtonian fluid:
///
///   σ = −p I + 2 μ(γ̇) ε(u),   γ̇² = 2 ε:ε
///
/// A law is a value without hidden state; one object serves all elements.
class ViscosityLaw {
public:
  virtual ~ViscosityLaw() = default;

  /// Viscosity at the square of a shear rate [1/ms²].
  virtual Viscosity at(double squared_shear_rate) const = 0;
  /// True if the viscosity is the same at all rates; terms of its slope are then omitted.
  virtual bool is_constant() const { return false; }
  /// Viscosity for estimates and profiles that assume a constant one: that at high rates [kPa ms].
  virtual double reference() const = 0;
};

}  // namespace tunica::materials
