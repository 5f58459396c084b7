// A smooth motion of the unit cube, clamped all around, with the body force that makes it exact
// for Mooney-Rivlin material; the gradient of d goes up to 0.3.
//
//   d_i = g(t) a_i (1 + X_{i+1}) sin(πX) sin(πY) sin(πZ),   p = −κ (J − 1),   cyclic
//   g   = (1 − cos ωt)²/4, at rest and without acceleration at t = 0
//   f   = ∂²d/∂t² − Div P/ρ,   P = ∂W/∂F,   W = Ψ'(FᵀF) + κ/2 (det F − 1)²
//
// Ψ' is the oracle's, from the invariants; ∂/∂F and Div are automatic differentiation. The
// stabilisation without inertia is used, which does not depend on Δt. Its residual lacks Div of
// the isochoric stress, which linear elements do not see: PSPG changes the volume by τ Div, of
// second order. κ is moderate because Newmark with γ = 1/2 lets the pressure of a nearly
// incompressible wall oscillate.

#include <Teuchos_UnitTestHarness.hpp>

#include "cube.hpp"
#include "field_of.hpp"
#include "oracle/mooney_rivlin_energy.hpp"
#include "oracle/quadrature.hpp"
#include "tunica/base/error.hpp"
#include "tunica/problems/solid_problem.hpp"

namespace {

using namespace tunica;

constexpr double density = 1.2, kappa = 20.0, omega = 4.0, duration = 1.0;
constexpr Vec3 a{0.07, -0.06, 0.065};
constexpr oracle::MooneyRivlinEnergy energy{3.0, 0.3};
const double pi = std::acos(-1.0);

double g(double t) { return 0.25 * std::pow(1.0 - std::cos(omega * t), 2); }
double g_dotdot(double t) {
  return 0.5 * omega * omega * (std::cos(omega * t) - std::cos(2.0 * omega * t));
}

/// d for g = 1.
Vec3 shape(const Vec3& X) {
  const double s = std::sin(pi * X[0]) * std::sin(pi * X[1]) * std::sin(pi * X[2]);
  return {a[0] * (1.0 + X[1]) * s, a[1] * (1.0 + X[2]) * s, a[2] * (1.0 + X[0]) * s};
}

/// F = I + g ∇d with the derivatives that X carries.
template <class S>
oracle::Mat<S> deformation(const oracle::Vec<S>& X, double factor) {
  using std::cos, std::sin;
  const S s = sin(pi * X[0]) * sin(pi * X[1]) * sin(pi * X[2]);
  oracle::Mat<S> F;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      const S slope = pi * cos(pi * X[j]) * sin(pi * X[(j + 1) % 3]) * sin(pi * X[(j + 2) % 3]);
      F[i][j] = factor * a[i] * (1.0 + X[(i + 1) % 3]) * slope;
      if (i == j) F[i][j] += 1.0;
      if (j == (i + 1) % 3) F[i][j] += factor * a[i] * s;
    }
  return F;
}

double pressure(const Vec3& X, double t) {
  return -kappa * (oracle::determinant(deformation<double>(X, g(t))) - 1.0);
}

Vec3 body_force(const Vec3& at, double t) {
  using InX = oracle::First<3>;
  using InF = Sacado::Fad::SFad<InX, 9>;
  oracle::Vec<InX> X;
  for (int i = 0; i < 3; ++i) oracle::seed(X[i], i, at[i]);
  const oracle::Mat<InX> F_of_X = deformation(X, g(t));
  oracle::Mat<InF> F;
  for (int i = 0; i < 3; ++i)
    for (int J = 0; J < 3; ++J) F[i][J] = InF(9, 3 * i + J, F_of_X[i][J]);
  const InF dilatation = oracle::determinant(F) - 1.0;
  const InF W = energy(oracle::gram(F)) + 0.5 * kappa * dilatation * dilatation;
  Vec3 f = g_dotdot(t) * shape(at);
  for (int i = 0; i < 3; ++i)
    for (int J = 0; J < 3; ++J) f[i] -= W.dx(3 * i + J).dx(J) / density;
  return f;
}

struct Newmark {
  const char* beta;
  const char* gamma;
};
constexpr Newmark second_order{"0.25", "0.5"}, first_order{"0.625", "1"};

Teuchos::ParameterList options(const Newmark& scheme, const std::string& method,
                               const std::string& residual = "linear") {
  using verify::entry;
  using verify::sublist;
  return verify::resolved(
      problems::solid_table(),
      sublist("Layers",
              sublist("fluid", entry("law", "string", "mooney-rivlin") +
                                   entry("c10", "double", "3") + entry("c01", "double", "0.3") +
                                   entry("bulk modulus", "double", "20") +
                                   entry("density", "double", "1.2"))) +
          sublist("Surfaces", sublist("boundary", entry("condition", "string", "clamped"))) +
          sublist("Newmark",
                  entry("beta", "double", scheme.beta) + entry("gamma", "double", scheme.gamma)) +
          entry("time scheme", "string", "newmark") + entry("stabilisation", "string", "paper") +
          entry("stabilisation modulus factor", "double", "4") +
          entry("stabilisation residual", "string", residual) +
          sublist("Newton", entry("relative increment", "double", "1e-11")) +
          sublist("Linear Solver", entry("method", "string", method)));
}

void march(problems::SolidProblem& wall, int steps) {
  wall.field().set_body_force(body_force);
  for (stepping::Clock clock(duration / steps, steps); !clock.is_done(); clock.advance()) {
    wall.begin_step(clock);
    const nonlinear::NewtonReport report = wall.solve();
    TUNICA_CHECK(report.is_converged, report.reason);
    wall.end_step();
  }
}

struct Errors {
  double d, p;
};

/// L2 norms over the undeformed cube at the end.
Errors errors_of(const problems::SolidProblem& wall) {
  const fields::FieldMesh& mesh = wall.mesh();
  const auto d = fields::ghosted_vectors(mesh, wall.state()[0]);
  const auto p = fields::ghosted_scalars(mesh, wall.state()[1]);
  double d2 = 0.0, p2 = 0.0;
  for (std::size_t e = 0; e < mesh.tets.size(); ++e) {
    if (!mesh.is_owned[e]) continue;
    for (const oracle::TetPoint& point : oracle::tet_rule()) {
      Vec3 X{}, d_h{};
      double p_h = 0.0;
      for (int b = 0; b < 4; ++b) {
        const int node = mesh.tets[e][b];
        X += point.N[b] * mesh.x[node];
        d_h += point.N[b] * d[node];
        p_h += point.N[b] * p[node];
      }
      const double dV = point.weight * wall.field().elements().geometry[e].volume;
      const Vec3 error = d_h - g(duration) * shape(X);
      d2 += dV * dot(error, error);
      p2 += dV * std::pow(p_h - pressure(X, duration), 2);
    }
  }
  return {std::sqrt(global_sum(*mesh.comm, d2)), std::sqrt(global_sum(*mesh.comm, p2))};
}

TEUCHOS_UNIT_TEST(manufactured_wall, motion_converges_at_second_and_first_order) {
  Errors last{};
  int n_old = 1;
  for (const int n : {6, 9, 13}) {  // Δt ~ h
    const fields::FieldMesh field = verify::field_of(verify::make_cube(n));
    problems::SolidProblem wall(options(second_order, "gcr"), field);
    march(wall, 3 * n);
    const Errors errors = errors_of(wall);
    out << "n " << n << ": displacement " << errors.d << ", pressure " << errors.p << "\n";
    if (n_old > 1) {
      TEST_COMPARE(verify::order(last.d, errors.d, double(n) / n_old), >=, 1.8);
      TEST_COMPARE(verify::order(last.p, errors.p, double(n) / n_old), >=, 1.0);
    }
    last = errors;
    n_old = n;
  }
  TEST_COMPARE(last.d, <, 2e-3);
}

TEUCHOS_UNIT_TEST(manufactured_wall, stress_residual_keeps_the_order_and_lessens_the_error) {
  std::vector<Errors> found;
  for (const int n : {6, 9}) {
    const fields::FieldMesh field = verify::field_of(verify::make_cube(n));
    problems::SolidProblem wall(options(second_order, "gcr", "stress"), field);
    march(wall, 3 * n);
    found.push_back(errors_of(wall));
    out << "n " << n << ": displacement " << found.back().d << ", pressure " << found.back().p
        << "\n";
  }
  TEST_COMPARE(verify::order(found[0].d, found[1].d, 1.5), >=, 1.8);
  TEST_COMPARE(verify::order(found[0].p, found[1].p, 1.5), >=, 1.5);
  TEST_COMPARE(found[1].d, <, 2.6e-3);  // without: 2.76e-3
}

double order_in_time(const Newmark& scheme, int steps, std::ostream& out) {
  const fields::FieldMesh field = verify::field_of(verify::make_cube(3));
  std::vector<std::vector<Vec3>> d;
  for (const int factor : {1, 2, 4}) {
    problems::SolidProblem wall(options(scheme, "direct"), field);
    march(wall, factor * steps);
    d.push_back(wall.displacement());
  }
  const double coarse = verify::distance(d[0], d[1]), fine = verify::distance(d[1], d[2]);
  out << "differences " << coarse << " " << fine << ", order " << verify::order(coarse, fine)
      << "\n";
  return verify::order(coarse, fine);
}

TEUCHOS_UNIT_TEST(manufactured_wall, newmark_with_gamma_one_half_is_of_second_order) {
  TEST_FLOATING_EQUALITY(order_in_time(second_order, 40, out), 2.0, 0.1);
}

TEUCHOS_UNIT_TEST(manufactured_wall, newmark_with_gamma_one_is_of_first_order) {
  TEST_FLOATING_EQUALITY(order_in_time(first_order, 200, out), 1.0, 0.1);
}

}  // namespace
