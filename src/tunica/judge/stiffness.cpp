#include "tunica/judge/stiffness.hpp"

#include <Teuchos_LAPACK.hpp>
#include <array>

#include "tunica/base/error.hpp"

namespace tunica::judge {

double circumferential_modulus(const materials::WallLaw& law, double kappa) {
  constexpr double strain = 1e-7;  // fibres along the vessel stay below their slack of 1e-12
  constexpr int around = 1;        // of x, y, z: radial, circumferential, axial
  const Sym3 C{1.0 - 2.0 * strain, 1.0 + 2.0 * strain, 1.0, 0.0, 0.0, 0.0};
  Sym3Map D = law.response(C, materials::Frame{}, {}).D;
  for (int I = 0; I < 3; ++I)
    for (int J = 0; J < 3; ++J) D[I][J] += kappa;
  Sym3 stress{};
  stress[around] = 1.0;
  std::array<int, 6> pivots{};
  int info = 0;  // D is symmetric and positive definite: row by row is column by column
  Teuchos::LAPACK<int, double>().GESV(6, 1, D[0].data(), 6, pivots.data(), stress.data(), 6, &info);
  TUNICA_ASSERT(info == 0, "the tangent of a wall at rest is regular");
  return 1.0 / stress[around];
}

}  // namespace tunica::judge
