#include "tunica/app/sanity/stiffness.hpp"

#include <cmath>
#include <utility>

namespace tunica::app {

namespace {

/// x of D x = b by elimination with pivots; D is small and positive definite.
Sym3 solve(Sym3Map D, Sym3 b) {
  constexpr int n = 6;
  for (int k = 0; k < n; ++k) {
    int pivot = k;
    for (int i = k + 1; i < n; ++i)
      if (std::abs(D[i][k]) > std::abs(D[pivot][k])) pivot = i;
    std::swap(D[k], D[pivot]);
    std::swap(b[k], b[pivot]);
    for (int i = k + 1; i < n; ++i) {
      const double factor = D[i][k] / D[k][k];
      for (int j = k; j < n; ++j) D[i][j] -= factor * D[k][j];
      b[i] -= factor * b[k];
    }
  }
  for (int k = n - 1; k >= 0; --k) {
    for (int j = k + 1; j < n; ++j) b[k] -= D[k][j] * b[j];
    b[k] /= D[k][k];
  }
  return b;
}

}  // namespace

double circumferential_modulus(const materials::HyperelasticLaw& law, double kappa) {
  constexpr double strain = 1e-7;  // fibres along the vessel stay below their slack of 1e-12
  constexpr int around = 1;        // of x, y, z: radial, circumferential, axial
  const Sym3 C{1.0 - 2.0 * strain, 1.0 + 2.0 * strain, 1.0, 0.0, 0.0, 0.0};
  Sym3Map D = law.response(C, materials::Frame{}).D;
  for (int I = 0; I < 3; ++I)
    for (int J = 0; J < 3; ++J) D[I][J] += kappa;
  Sym3 stress{};
  stress[around] = 1.0;
  return 1.0 / solve(D, stress)[around];
}

}  // namespace tunica::app
