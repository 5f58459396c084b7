#include "tunica/kernels/principal_axes.hpp"

#include <cmath>
#include <utility>

namespace tunica::kernels {

namespace {

/// A ← Gᵀ A G, such that A_pq = 0; the rows of Q ← Gᵀ Q are directions.
void rotate(int p, int q, Mat3& A, Mat3& Q) {
  if (A[p][q] == 0.0) return;
  const double theta = 0.5 * (A[q][q] - A[p][p]) / A[p][q];
  const double t = (theta >= 0.0 ? 1.0 : -1.0) / (std::abs(theta) + std::sqrt(theta * theta + 1.0));
  const double c = 1.0 / std::sqrt(t * t + 1.0), s = t * c;
  const auto turn = [c, s](double& at_p, double& at_q) {
    const double old = at_p;
    at_p = c * old - s * at_q;
    at_q = s * old + c * at_q;
  };
  for (int k = 0; k < 3; ++k) turn(A[k][p], A[k][q]);
  for (int k = 0; k < 3; ++k) turn(A[p][k], A[q][k]);
  for (int k = 0; k < 3; ++k) turn(Q[p][k], Q[q][k]);
}

}  // namespace

PrincipalAxes principal_axes(const Sym3& A) {
  Mat3 D{{{A[0], A[3], A[5]}, {A[3], A[1], A[4]}, {A[5], A[4], A[2]}}};
  Mat3 Q = identity();
  const double size = std::abs(A[0]) + std::abs(A[1]) + std::abs(A[2]);
  // Each sweep squares what is left beside the diagonal, which is seen at the squares of values.
  for (int sweep = 0; sweep < 8; ++sweep) {
    const double rest = std::abs(D[0][1]) + std::abs(D[0][2]) + std::abs(D[1][2]);
    if (rest <= 1e-12 * size) break;
    rotate(0, 1, D, Q);
    rotate(0, 2, D, Q);
    rotate(1, 2, D, Q);
  }
  PrincipalAxes axes{{D[0][0], D[1][1], D[2][2]}, {Q[0], Q[1], Q[2]}};
  for (const auto& [i, j] : {std::pair{0, 1}, {1, 2}, {0, 1}})
    if (axes.values[i] < axes.values[j]) {
      std::swap(axes.values[i], axes.values[j]);
      std::swap(axes.directions[i], axes.directions[j]);
    }
  return axes;
}

}  // namespace tunica::kernels
