#include "tunica/smoothers/braess_sarazin/ritz_values.hpp"

#include <Teuchos_LAPACK.hpp>
#include <cmath>

#include "tunica/algebra/without_pattern.hpp"

namespace tunica::smoothers {

namespace {

/// Of a Hessenberg matrix, by columns; what LAPACK writes over is its own copy.
std::vector<std::complex<double>> eigenvalues(std::vector<double> H, int rows, int n) {
  std::vector<double> real(n), imaginary(n), work(11 * n);
  int info = 0;
  Teuchos::LAPACK<int, double>().HSEQR('E', 'N', n, 1, n, H.data(), rows, real.data(),
                                       imaginary.data(), nullptr, 1, work.data(),
                                       static_cast<int>(work.size()), &info);
  std::vector<std::complex<double>> values;
  for (int i = 0; info == 0 && i < n; ++i) values.emplace_back(real[i], imaginary[i]);
  return values;
}

}  // namespace

std::vector<std::complex<double>> ritz_values(
    const Teuchos::RCP<const Map>& map,
    const std::function<void(const Vector& x, Vector& y)>& apply, int steps) {
  constexpr double nothing = 1e-10;  // of |A v|, beside which the rest is an invariant space
  std::vector<Vector> V{Vector(map)};
  algebra::fill_without_pattern(V[0]);
  std::vector<double> H(static_cast<std::size_t>(steps) * steps);
  const double size = V[0].norm2();
  if (!(size > 0.0)) return {};
  V[0].scale(1.0 / size);
  // A V_k = V_k H_k + h_k+1,k v_k+1 e_kᵀ, Gram and Schmidt's way
  for (int k = 0; k < steps; ++k) {
    Vector w(map);
    apply(V[k], w);
    const double before = w.norm2();
    for (int i = 0; i <= k; ++i) {
      const double h = V[i].dot(w);
      w.update(-h, V[i], 1.0);
      H[i + k * steps] = h;
    }
    const double next = w.norm2();
    if (!std::isfinite(next)) return {};
    if (k + 1 == steps || next <= nothing * before) return eigenvalues(H, steps, k + 1);
    H[k + 1 + k * steps] = next;
    w.scale(1.0 / next);
    V.push_back(w);
  }
  return {};
}

}  // namespace tunica::smoothers
