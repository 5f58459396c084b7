#include "tunica/kernels/energy.hpp"

#include "tunica/kernels/deformation.hpp"
#include "tunica/kernels/viscosity.hpp"

namespace tunica::kernels {

double squared_norm(double volume, const std::array<double, 4>& v) {
  const double sum = v[0] + v[1] + v[2] + v[3];
  const double squares = v[0] * v[0] + v[1] * v[1] + v[2] * v[2] + v[3] * v[3];
  return volume / 20.0 * (sum * sum + squares);
}

double squared_norm(double volume, const std::array<Vec3, 4>& v) {
  double total = 0.0;
  for (int i = 0; i < 3; ++i)
    total += squared_norm(volume, std::array<double, 4>{v[0][i], v[1][i], v[2][i], v[3][i]});
  return total;
}

double viscous_dissipation(const Tet4& T, const std::array<Vec3, 4>& u,
                           const materials::ViscosityLaw& viscosity) {
  const Mat3 G = gradient(T, u);
  return viscosity_at(viscosity, G).value * T.volume * squared_shear_rate(G);  // 2μ ε:ε = μ γ̇²
}

double power_of_divergence(const Tet4& T, const std::array<Vec3, 4>& u, double density) {
  const Mat3 G = gradient(T, u);
  return 0.5 * density * (G[0][0] + G[1][1] + G[2][2]) * squared_norm(T.volume, u);
}

double subscale_power(const Tet4& T, const std::array<Vec3, 4>& d, const std::array<double, 4>& p,
                      const Vec3& velocity) {
  Vec3 gradient{0, 0, 0};
  for (int a = 0; a < 4; ++a) gradient += p[a] * T.grad_N[a];
  const Mat3 J_F_inv_T = transpose(adjugate(deformation_gradient(T, d)));
  return -T.volume * dot(J_F_inv_T * gradient, velocity);
}

}  // namespace tunica::kernels
