// Steady flow in a rigid round tube, driven by pressures at both ends. Poiseuille's flow does
// not satisfy σn = −pn there: its symmetric stress has the shear traction μ ∂u_z/∂r e_r, so
// each end has a layer about one radius long (modes decay as e^{−4.5 z/R}). Flow rate and
// pressure gradient are therefore taken where the flow is developed, two radii from the ends:
//
//   Q = π R⁴ G / (8 μ),   G = −dp/dz
//
// What remains is the error of the mesh: chords instead of circles and linear elements.

#include <Teuchos_UnitTestHarness.hpp>

#include "base/error.hpp"
#include "field_of.hpp"
#include "mesh/tube.hpp"
#include "problems/fluid_problem.hpp"

namespace {

using namespace tunica;
using verify::entry;
using verify::sublist;

constexpr double R = 1.43, length = 6.0 * R, viscosity = 0.1, pressure = 0.04;

Teuchos::ParameterList options() {
  const auto end = [](const std::string& p) {
    return entry("condition", "string", "pressure") + entry("pressure", "double", p);
  };
  return verify::resolved(
      problems::fluid_table(),
      entry("density", "double", "1") + entry("viscosity", "double", "0.1") +
          sublist("Surfaces", sublist("inlet", end("0.04")) + sublist("outlet", end("0")) +
                                  sublist("interface", entry("condition", "string", "no slip"))) +
          sublist("Linear Solver", entry("method", "string", "direct")));
}

/// Mean pressure in the cross-section through vertices at z.
double section_pressure(const problems::FluidProblem& fluid, double z) {
  const auto p = fluid.state().p->getLocalViewHost(Tpetra::Access::ReadOnly);
  return verify::mean_over_nodes(fluid.mesh(), [&](int a) {
    return std::abs(fluid.mesh().x[a][2] - z) < 1e-9 ? p(a, 0) : std::nan("");
  });
}

double inflow(const problems::FluidProblem& fluid, const std::string& surface) {
  for (const problems::Observable& o : fluid.observe())
    if (o.name == "inflow_" + surface + "_mm3_per_ms") return o.value;
  return std::nan("");
}

struct Flow {
  double through;   ///< Q / (π R⁴ G / 8μ)
  double leak;      ///< (inflow + outflow) / inflow
  double change;    ///< of Q in the last time step, relative
};

Flow flow_on(int n) {
  mesh::Tube tube;
  tube.with_wall = false;
  tube.radius = R;
  tube.length = length;
  tube.around = 8 * n;
  tube.axial = 6 * n;
  const fields::FieldMesh field = verify::field_of(mesh::make_tube(tube));
  problems::FluidProblem fluid(options(), field);
  double Q = 0.0, last = 0.0;
  for (stepping::Clock clock(1e4, 4); !clock.is_done(); clock.advance()) {
    fluid.begin_step(clock);
    const nonlinear::NewtonReport report = fluid.solve();
    TUNICA_CHECK(report.is_converged, report.reason);
    last = Q;
    Q = inflow(fluid, "inlet");
  }
  const double G =
      (section_pressure(fluid, 2.0 * R) - section_pressure(fluid, 4.0 * R)) / (2.0 * R);
  const double exact = std::acos(-1.0) * std::pow(R, 4) * G / (8.0 * viscosity);
  return {Q / exact, (Q + inflow(fluid, "outlet")) / Q, (Q - last) / Q};
}

TEUCHOS_UNIT_TEST(poiseuille, flow_rate_converges_to_the_exact_one_at_second_order) {
  double last = 0.0;
  for (const int n : {1, 2, 4}) {
    const Flow flow = flow_on(n);
    const double error = std::abs(flow.through - 1.0);
    out << "n " << n << ": Q / exact " << flow.through << ", leak " << flow.leak << ", change "
        << flow.change << ", order " << verify::order(last, error) << "\n";
    TEST_COMPARE(std::abs(flow.leak), <, 1e-9);
    TEST_COMPARE(std::abs(flow.change), <, 1e-6);
    if (n > 1) TEST_COMPARE(verify::order(last, error), >=, 1.8);
    if (n == 4) TEST_COMPARE(error, <, 0.03);
    last = error;
  }
}

}  // namespace
