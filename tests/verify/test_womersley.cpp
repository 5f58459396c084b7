// Oscillating flow in a rigid round tube, driven by a pressure at one end. As in
// test_poiseuille.cpp the ends have layers about a radius long, so pressure gradient, flow rate
// and profile are compared where the flow is developed, two radii from the ends: amplitudes and
// phases over the last period, and the exact flow for the gradient found there.
//
// Implicit Euler turns iω into s = (1 − e^{−iωΔt})/Δt. The exact flow with this s has the same
// error of time, so what remains against it is the error of space; with iω it is both.

#include <Teuchos_UnitTestHarness.hpp>

#include "field_of.hpp"
#include "tunica/base/error.hpp"
#include "tunica/problems/fluid_problem.hpp"
#include "womersley.hpp"

namespace {

using namespace tunica;
using verify::Complex;
using verify::entry;
using verify::sublist;

constexpr double R = 1.0, length = 6.0, density = 1.0, viscosity = 0.05, period = 8.0;
const double omega = 2.0 * std::acos(-1.0) / period;  // Womersley number R √(ωρ/μ) = 4.0

/// 0.5 kPa cos ωt at the inlet, sampled at the ends of the time steps, none at the outlet: the
/// fluid's path is short against the tube.
Teuchos::ParameterList options(int steps, int periods) {
  std::ostringstream times, values;
  for (int k = 0; k <= steps * periods; ++k) {
    times << (k > 0 ? "," : "{") << period * k / steps;
    values << (k > 0 ? "," : "{") << std::cos(omega * period * k / steps);
  }
  return verify::resolved(
      problems::fluid_table(),
      entry("density", "double", "1") + entry("viscosity", "double", "0.05") +
          entry("time scheme", "string", "implicit euler") +
          sublist("Surfaces",
                  sublist("inlet",
                          entry("condition", "string", "pressure") +
                              entry("pressure", "double", "0.5") +
                              sublist("Amplitude",
                                      entry("kind", "string", "table") +
                                          entry("times", "Array(double)", times.str() + "}") +
                                          entry("values", "Array(double)", values.str() + "}"))) +
                      sublist("interface", entry("condition", "string", "no slip"))) +
          sublist("Linear Solver",
                  entry("method", "string", "gcr") + entry("preconditioner", "string", "direct")));
}

/// Sums of a period with e^{−iωt} for the amplitudes of what is developed.
class Amplitudes {
public:
  explicit Amplitudes(const problems::FluidProblem& fluid)
      : fluid_(&fluid), u_(fluid.mesh().n_owned) {}

  void add(double time, int steps) {
    const fields::FieldMesh& mesh = fluid_->mesh();
    const Complex phase = 2.0 / steps * std::exp(Complex(0.0, -omega * time));
    const auto u = fields::ghosted_vectors(mesh, fluid_->state()[0]);
    gradient_ += phase * (section_pressure(2.0 * R) - section_pressure(4.0 * R)) / (2.0 * R);
    flow_ += phase * developed_flow(u);
    for (int a = 0; a < mesh.n_owned; ++a) u_[a] += phase * u[a][2];
  }
  Complex gradient() const { return gradient_; }
  Complex flow() const { return flow_; }

  /// Distance of the nodal velocities at half the length from the exact ones, relative.
  double profile_error(const verify::Womersley& exact) const {
    const fields::FieldMesh& mesh = fluid_->mesh();
    double error = 0.0, size = 0.0;
    for (int a = 0; a < mesh.n_owned; ++a) {
      if (std::abs(mesh.x[a][2] - 3.0 * R) > 1e-9) continue;
      const Complex u = exact.velocity(gradient_, std::hypot(mesh.x[a][0], mesh.x[a][1]));
      error += std::norm(u_[a] - u);
      size += std::norm(u);
    }
    return std::sqrt(error / size);
  }

private:
  double section_pressure(double z) const {
    const auto p = fluid_->state()[1].getLocalViewHost(read_only);
    return verify::mean_over_nodes(fluid_->mesh(), [&](int a) {
      return std::abs(fluid_->mesh().x[a][2] - z) < 1e-9 ? p(a, 0) : std::nan("");
    });
  }
  /// ∫ u_z dA, averaged over the sections from 2R to 4R.
  double developed_flow(const std::vector<Vec3>& u) const {
    const fields::FieldMesh& mesh = fluid_->mesh();
    double sum = 0.0;
    for (std::size_t e = 0; e < mesh.tets.size(); ++e) {
      double z = 0.0, mean = 0.0;
      for (const int a : mesh.tets[e]) {
        z += 0.25 * mesh.x[a][2];
        mean += 0.25 * u[a][2];
      }
      if (z > 2.0 * R && z < 4.0 * R) sum += fluid_->field().elements().geometry[e].volume * mean;
    }
    return sum / (2.0 * R);
  }

  const problems::FluidProblem* fluid_;
  Complex gradient_ = 0.0, flow_ = 0.0;
  std::vector<Complex> u_;
};

struct Comparison {
  Complex flow;          ///< Q̂/Ĝ
  double error;          ///< of it, relative to the flow with implicit Euler's s
  double profile_error;  ///< likewise
  double error_of_both;  ///< relative to the flow with iω
};

Comparison flow_on(int n, int steps, std::ostream& out) {
  const fields::FieldMesh field = verify::lumen(R, length, n);
  constexpr int periods = 2;
  problems::FluidProblem fluid(options(steps, periods), field);
  const verify::Womersley exact{density, viscosity, R, Complex(0.0, omega)};
  const verify::Womersley euler{
      density, viscosity, R,
      (1.0 - std::exp(Complex(0.0, -omega * period / steps))) * (steps / period)};
  fluid.set_initial_velocity([&](const Vec3& x) {
    return Vec3{0, 0, euler.velocity(0.5 / length, std::hypot(x[0], x[1])).real()};
  });
  Amplitudes found(fluid);
  for (stepping::Clock clock(period / steps, periods * steps); !clock.is_done(); clock.advance()) {
    fluid.begin_step(clock);
    const nonlinear::NewtonReport report = fluid.solve();
    TUNICA_CHECK(report.is_converged, report.reason);
    fluid.end_step();
    if (clock.step() > (periods - 1) * steps) found.add(clock.time(), steps);
  }
  const Complex flow = found.flow() / found.gradient();
  const Comparison result{flow, std::abs(flow / euler.flow_rate(1.0) - 1.0),
                          found.profile_error(euler), std::abs(flow / exact.flow_rate(1.0) - 1.0)};
  out << "n " << n << ", " << steps << " steps: flow " << flow << ", error " << result.error
      << ", of the profile " << result.profile_error << ", against iω " << result.error_of_both
      << "\n";
  return result;
}

TEUCHOS_UNIT_TEST(womersley, flow_and_profile_converge_at_second_order_in_space) {
  const Comparison coarse = flow_on(2, 16, out), fine = flow_on(4, 16, out);
  TEST_COMPARE(verify::order(coarse.error, fine.error), >=, 1.7);
  TEST_COMPARE(verify::order(coarse.profile_error, fine.profile_error), >=, 1.9);
  TEST_COMPARE(fine.error, <, 0.035);
  TEST_COMPARE(fine.profile_error, <, 0.04);
}

TEUCHOS_UNIT_TEST(womersley, flow_converges_at_first_order_in_time) {
  std::vector<Complex> flow;
  for (const int steps : {16, 32, 64}) flow.push_back(flow_on(2, steps, out).flow);
  TEST_FLOATING_EQUALITY(verify::order(std::abs(flow[0] - flow[1]), std::abs(flow[1] - flow[2])),
                         1.0, 0.15);
}

TEUCHOS_UNIT_TEST(womersley, bessel_functions_have_their_known_values) {
  // Abramowitz and Stegun, tables 9.1 and 9.9: J0(2), J1(2), and ber 1 + i bei 1 = J0(e^{3πi/4})
  TEST_FLOATING_EQUALITY(verify::bessel(0, 2.0).real(), 0.223890779141236, 1e-12);
  TEST_FLOATING_EQUALITY(verify::bessel(1, 2.0).real(), 0.576724807756873, 1e-12);
  const Complex kelvin = verify::bessel(0, std::polar(1.0, 0.75 * std::acos(-1.0)));
  TEST_FLOATING_EQUALITY(kelvin.real(), 0.9843817812, 1e-9);
  TEST_FLOATING_EQUALITY(kelvin.imag(), 0.2495660400, 1e-9);
}

}  // namespace
