#include "tunica/kernels/surface_tri3.hpp"

namespace tunica::kernels {

// Surface terms on one linear triangle.
//
//   dead traction      R[a] = −∫ N_a t dA           = −|n|/3 t
//   follower pressure  R[a] =  ∫ N_a p ν da         = p/3 n,       n = ½ (x1 − x0)×(x2 − x0)
//   backflow           R[a] = −β ρ ∫ (c·ν)₋ u N_a da,               c = u − w
//
//   n   area times outward unit normal ν   mm²      t  traction    kPa
//   u   fluid velocity, w mesh velocity    mm/ms    p  pressure    kPa
//   β   backflow factor, 0 to 1            1        ρ  density     mg/mm³
//
// The first two are exact. Backflow is a sum over 7 points of degree 5: exact (cubic integrand)
// where the flow has one direction all over the triangle; its derivative is that of the sum.
//
// Source: backflow [EM1], the 7 points [Ra1].
// Deviation: [EM1] has c = u; on a moving mesh only u − w enters.

namespace {

constexpr double sqrt15 = 3.872983346207417;
constexpr double near = (6.0 - sqrt15) / 21.0;  // both small coordinates near a vertex
constexpr double far = (6.0 + sqrt15) / 21.0;   // both large coordinates near a midpoint
constexpr double ring_near = (155.0 - sqrt15) / 1200.0;
constexpr double ring_far = (155.0 + sqrt15) / 1200.0;

struct QuadraturePoint {
  double weight;  ///< they add up to 1
  double N[3];
};

constexpr QuadraturePoint points[7] = {
    {0.225, {1.0 / 3.0, 1.0 / 3.0, 1.0 / 3.0}},  {ring_near, {near, near, 1.0 - 2.0 * near}},
    {ring_near, {near, 1.0 - 2.0 * near, near}}, {ring_near, {1.0 - 2.0 * near, near, near}},
    {ring_far, {far, far, 1.0 - 2.0 * far}},     {ring_far, {far, 1.0 - 2.0 * far, far}},
    {ring_far, {1.0 - 2.0 * far, far, far}},
};

Vec3 interpolate(const double N[3], const std::array<Vec3, 3>& v) {
  return N[0] * v[0] + N[1] * v[1] + N[2] * v[2];
}

/// Adds the backflow term to R and, where K is given, its derivative to K.
void add_backflow(const std::array<Vec3, 3>& x, const std::array<Vec3, 3>& u,
                  const std::array<Vec3, 3>& w, double beta_rho, SurfaceResidual& R,
                  SurfaceJacobian* K) {
  const Vec3 n = area_normal(x);
  for (const QuadraturePoint& point : points) {
    const Vec3 v = interpolate(point.N, u);
    const double flux = dot(v - interpolate(point.N, w), n);
    if (flux >= 0.0) continue;
    const double factor = -beta_rho * point.weight;
    for (int a = 0; a < 3; ++a) {
      R.u[a] += (factor * flux * point.N[a]) * v;
      if (!K) continue;
      for (int b = 0; b < 3; ++b) {
        const double NN = factor * point.N[a] * point.N[b];
        for (int i = 0; i < 3; ++i) {
          K->A[a][b][i][i] += NN * flux;
          for (int j = 0; j < 3; ++j) K->A[a][b][i][j] += NN * v[i] * n[j];
        }
      }
    }
  }
}

}  // namespace

Vec3 area_normal(const std::array<Vec3, 3>& x) { return 0.5 * cross(x[1] - x[0], x[2] - x[0]); }

// ∂n/∂x_b: v -> ½ v × e, e the opposite edge against the orientation
std::array<Mat3, 3> area_normal_derivative(const std::array<Vec3, 3>& x) {
  std::array<Mat3, 3> D;
  for (int b = 0; b < 3; ++b) {
    const Vec3 e = 0.5 * (x[(b + 1) % 3] - x[(b + 2) % 3]);
    D[b] = {{{0.0, e[2], -e[1]}, {-e[2], 0.0, e[0]}, {e[1], -e[0], 0.0}}};
  }
  return D;
}

SurfaceResidual dead_traction(const std::array<Vec3, 3>& x, const Vec3& t) {
  const Vec3 share = (-norm(area_normal(x)) / 3.0) * t;
  return {{share, share, share}};
}

// ∂|n| = ν·∂n
void dead_traction_shape(const std::array<Vec3, 3>& x, const Vec3& t, SurfaceJacobian& K) {
  const Vec3 n = area_normal(x);
  const std::array<Mat3, 3> D = area_normal_derivative(x);
  for (int b = 0; b < 3; ++b) {
    const Vec3 of_area = 1.0 / norm(n) * (transpose(D[b]) * n);
    for (int a = 0; a < 3; ++a)
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) K.A[a][b][i][j] = -t[i] * of_area[j] / 3.0;
  }
}

SurfaceResidual follower_pressure(const std::array<Vec3, 3>& x, double pressure) {
  const Vec3 share = (pressure / 3.0) * area_normal(x);
  return {{share, share, share}};
}

void follower_pressure_jacobian(const std::array<Vec3, 3>& x, double pressure, SurfaceResidual& R,
                                SurfaceJacobian& K) {
  R = follower_pressure(x, pressure);
  const std::array<Mat3, 3> D = area_normal_derivative(x);
  for (int a = 0; a < 3; ++a)
    for (int b = 0; b < 3; ++b)
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) K.A[a][b][i][j] = pressure / 3.0 * D[b][i][j];
}

SurfaceResidual backflow(const std::array<Vec3, 3>& x, const std::array<Vec3, 3>& u,
                         const std::array<Vec3, 3>& w, double beta_rho) {
  SurfaceResidual R{};
  add_backflow(x, u, w, beta_rho, R, nullptr);
  return R;
}

void backflow_jacobian(const std::array<Vec3, 3>& x, const std::array<Vec3, 3>& u,
                       const std::array<Vec3, 3>& w, double beta_rho, SurfaceResidual& R,
                       SurfaceJacobian& K) {
  R = {};
  K = {};
  add_backflow(x, u, w, beta_rho, R, &K);
}

void backflow_shape(const std::array<Vec3, 3>& x, const std::array<Vec3, 3>& u,
                    const std::array<Vec3, 3>& w, double beta_rho, double mesh_rate,
                    SurfaceJacobian& K) {
  const Vec3 n = area_normal(x);
  const std::array<Mat3, 3> D = area_normal_derivative(x);
  K = {};
  for (const QuadraturePoint& point : points) {
    const Vec3 v = interpolate(point.N, u), c = v - interpolate(point.N, w);
    if (dot(c, n) >= 0.0) continue;
    for (int b = 0; b < 3; ++b) {
      // ∂(c·n)/∂x_b
      const Vec3 of_flux = transpose(D[b]) * c - (mesh_rate * point.N[b]) * n;
      for (int a = 0; a < 3; ++a)
        for (int i = 0; i < 3; ++i)
          for (int j = 0; j < 3; ++j)
            K.A[a][b][i][j] -= beta_rho * point.weight * point.N[a] * v[i] * of_flux[j];
    }
  }
}

double kinetic_outflow(const std::array<Vec3, 3>& x, const std::array<Vec3, 3>& u,
                       const std::array<Vec3, 3>& w) {
  const Vec3 n = area_normal(x);
  double total = 0.0;
  for (const QuadraturePoint& point : points) {
    const Vec3 v = interpolate(point.N, u);
    total += 0.5 * point.weight * dot(v, v) * dot(v - interpolate(point.N, w), n);
  }
  return total;
}

}  // namespace tunica::kernels
