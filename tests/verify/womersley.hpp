#pragma once
#include <cmath>
#include <complex>

namespace tunica::verify {

using Complex = std::complex<double>;

/// Bessel function J_n of the first kind, n = 0 or 1, by its power series; to 1e-12 of e^|z|
/// for |z| ≤ 10.
inline Complex bessel(int n, Complex z) {
  Complex term = n == 0 ? Complex(1.0) : 0.5 * z, sum = term;
  for (int k = 1; k < 60; ++k) {
    term *= -0.25 * z * z / double(k * (k + n));
    sum += term;
  }
  return sum;
}

/// Flow in a rigid tube under the pressure gradient −dp/dz = Re(G e^{iωt}), [Wo55]:
///
///   u_z = Re(û e^{iωt}),   û(r) = G/(sρ) (1 − J0(Λr/R)/J0(Λ)),   Λ² = −sρR²/μ
///   Q   = Re(Q̂ e^{iωt}),   Q̂    = πR² G/(sρ) (1 − 2 J1(Λ)/(Λ J0(Λ)))
///
///   s   iω, or what a time scheme makes of it       1/ms
///   ρ   density   mg/mm³      μ   viscosity   kPa ms      R   radius   mm
struct Womersley {
  double density, viscosity, radius;
  Complex s;

  Complex velocity(Complex G, double r) const {
    return G / (s * density) * (1.0 - bessel(0, lambda() * r / radius) / bessel(0, lambda()));
  }
  Complex flow_rate(Complex G) const {
    const double area = std::acos(-1.0) * radius * radius;
    return area * G / (s * density) *
           (1.0 - 2.0 * bessel(1, lambda()) / (lambda() * bessel(0, lambda())));
  }

private:
  Complex lambda() const { return std::sqrt(-s * density * radius * radius / viscosity); }
};

}  // namespace tunica::verify
