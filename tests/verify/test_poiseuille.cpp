// Steady flow in a rigid round tube, driven by pressures at both ends. Poiseuille's flow does
// not satisfy σn = −pn there: its symmetric stress has the shear traction μ ∂u_z/∂r e_r, so
// each end has a layer about one radius long (modes decay as e^{−4.5 z/R}). Flow rate and
// pressure gradient are therefore compared where the flow is developed, two radii from the ends:
//
//   Q = π R⁴ G / (8 μ),   G = −dp/dz
//
// The mesh makes two errors. Chords and linear elements obstruct the flow: ∫ u_z dA is too
// small. And PSPG conserves the flux of u − (τ/ρ) r, r = ∇p − div 2με, not that of u. Where r
// lacks its viscous part, it is −G e_z, and with τ = ρ h²/(4μ) more passes the open ends than the
// sections between them: by 2 h²/R² of Q.

#include <Teuchos_UnitTestHarness.hpp>
#include <functional>
#include <map>

#include "field_of.hpp"
#include "tunica/base/error.hpp"
#include "tunica/problems/fluid_problem.hpp"

namespace {

using namespace tunica;
using verify::entry;
using verify::sublist;

const double pi = std::acos(-1.0);
constexpr double R = 1.43, length = 6.0 * R, viscosity = 0.1, pressure = 0.04;

Teuchos::ParameterList options(const std::string& law, const std::string& residual,
                               const std::string& viscous_factor) {
  const auto end = [](const std::string& p) {
    return entry("condition", "string", "pressure") + entry("pressure", "double", p);
  };
  return verify::resolved(
      problems::fluid_table(),
      entry("density", "double", "1") + law + entry("stabilisation residual", "string", residual) +
          entry("stabilisation viscous factor", "double", viscous_factor) +
          sublist("Surfaces", sublist("inlet", end("0.04")) + sublist("outlet", end("0")) +
                                  sublist("interface", entry("condition", "string", "no slip"))) +
          sublist("Linear Solver", entry("method", "string", "direct")));
}

/// Mean pressure in the cross-section through vertices at z.
double section_pressure(const problems::FluidProblem& fluid, double z) {
  const auto p = fluid.state()[1].getLocalViewHost(Tpetra::Access::ReadOnly);
  return verify::mean_over_nodes(fluid.mesh(), [&](int a) {
    return std::abs(fluid.mesh().x[a][2] - z) < 1e-9 ? p(a, 0) : std::nan("");
  });
}

double flow_through(const problems::FluidProblem& fluid, const std::string& surface) {
  for (const discretisation::Observable& o : fluid.observe())
    if (o.name == "inflow_" + surface + "_mm3_per_ms") return o.value;
  return std::nan("");
}

/// ∫ u_z dA, averaged over the sections from 2R to 4R.
double developed_flow(const problems::FluidProblem& fluid) {
  const fields::FieldMesh& mesh = fluid.mesh();
  const std::vector<Vec3> u = fields::ghosted_vectors(mesh, fluid.state()[0]);
  double sum = 0.0;
  for (std::size_t e = 0; e < mesh.tets.size(); ++e) {
    Vec3 centre{}, mean{};
    for (const int a : mesh.tets[e]) {
      centre += 0.25 * mesh.x[a];
      mean += 0.25 * u[a];
    }
    if (mesh.is_owned[e] && centre[2] > 2.0 * R && centre[2] < 4.0 * R)
      sum += fluid.field().elements().geometry[e].volume * mean[2];
  }
  return global_sum(*mesh.comm, sum) / (2.0 * R);
}

struct Flow {
  double inflow;     ///< through the inlet, in parts of π R⁴ G / (8μ)
  double developed;  ///< ∫ u_z dA of the middle sections, likewise
  double predicted;  ///< 2 h²/R², the part of the inflow that bypasses the sections without the
                     ///< viscous residual
  double leak;       ///< (inflow + outflow) / inflow
  double change;     ///< of the inflow in the last time step, relative
  double shear;      ///< wall shear stress between the same sections, mean in parts of R G/2
  double spread;     ///< largest difference from it there, likewise

  double bypass() const { return inflow - developed; }
};

/// Mean of the wall shear stress from 2R to 4R along the axis, and the largest difference from it.
std::array<double, 2> developed_shear(problems::FluidProblem& fluid) {
  const fields::FieldMesh& mesh = fluid.mesh();
  const int wall = mesh.surface_index("interface");
  const std::vector<Vec3> stress = fluid.wall_shear_stress();
  const auto at = [&](int a) {
    const double z = mesh.x[a][2];
    return mesh.is_on(a, wall) && z > 1.99 * R && z < 4.01 * R ? stress[a][2] : std::nan("");
  };
  const double mean = verify::mean_over_nodes(mesh, at);
  double mine = 0.0;
  for (int a = 0; a < mesh.n_owned; ++a)
    if (const double value = at(a); !std::isnan(value))
      mine = std::max(mine, norm(stress[a] - Vec3{0.0, 0.0, mean}));
  return {mean, global_max(*mesh.comm, mine)};
}

/// A law of the case, and the flow rate that it has under a pressure gradient.
struct Fluid {
  std::string entries;
  std::function<double(double G)> flow;
};

const Fluid newtonian{entry("viscosity", "double", "0.1"),
                      [](double G) { return pi * std::pow(R, 4) * G / (8.0 * viscosity); }};

Flow flow_on(int n, const std::string& residual = "viscous",
             const std::string& viscous_factor = "4", const Fluid& law = newtonian) {
  const fields::FieldMesh field = verify::lumen(R, length, n);
  problems::FluidProblem fluid(options(law.entries, residual, viscous_factor), field);
  double Q = 0.0, last = 0.0;
  for (stepping::Clock clock(1e4, 12); !clock.is_done(); clock.advance()) {
    fluid.begin_step(clock);
    const nonlinear::NewtonReport report = fluid.solve();
    TUNICA_CHECK(report.is_converged, report.reason);
    fluid.end_step();
    last = Q;
    Q = flow_through(fluid, "inlet");
  }
  const double G =
      (section_pressure(fluid, 2.0 * R) - section_pressure(fluid, 4.0 * R)) / (2.0 * R);
  const double exact = law.flow(G);
  double volume = 0.0, h2_volume = 0.0;
  for (std::size_t e = 0; e < field.tets.size(); ++e) {
    const double V = fluid.field().elements().geometry[e].volume;
    volume += V;
    h2_volume += V * std::pow(kernels::element_length(V), 2);
  }
  const auto [shear, spread] = developed_shear(fluid);
  return {Q / exact,
          developed_flow(fluid) / exact,
          2.0 * h2_volume / volume / (R * R),
          (Q + flow_through(fluid, "outlet")) / Q,
          (Q - last) / Q,
          shear / (0.5 * R * G),
          spread / (0.5 * R * G)};
}

/// With the defaults; several tests look at it.
const Flow& default_flow_on(int n) {
  static std::map<int, Flow> flows;
  const auto found = flows.find(n);
  return found != flows.end() ? found->second : flows.emplace(n, flow_on(n)).first->second;
}

TEUCHOS_UNIT_TEST(poiseuille, flow_rate_converges_to_the_exact_one_at_second_order) {
  Flow last{};
  for (const int n : {1, 2, 4}) {
    const Flow& flow = default_flow_on(n);
    out << "n " << n << ": inflow " << flow.inflow << ", developed flow " << flow.developed
        << ", predicted bypass " << flow.predicted << "\n";
    TEST_COMPARE(std::abs(flow.leak), <, 1e-9);
    // The viscous residual is that of the past, to which each step comes closer by a factor.
    TEST_COMPARE(std::abs(flow.change), <, 2e-4);
    TEST_COMPARE(flow.bypass(), <, 0.4 * flow.predicted);
    if (n > 1)
      TEST_COMPARE(verify::order(std::abs(last.inflow - 1.0), std::abs(flow.inflow - 1.0)), >=,
                   1.9);
    last = flow;
  }
  TEST_COMPARE(std::abs(last.inflow - 1.0), <, 0.02);
  TEST_COMPARE(std::abs(last.developed - 1.0), <, 0.03);
}

TEUCHOS_UNIT_TEST(poiseuille, wall_shear_stress_is_that_of_the_pressure_gradient) {
  std::vector<Flow> flows;
  for (const int n : {2, 4}) {
    flows.push_back(default_flow_on(n));
    out << "n " << n << ": wall shear stress " << flows.back().shear << " +- "
        << flows.back().spread << "\n";
  }
  TEST_COMPARE(std::abs(flows[0].shear - 1.0), <, 0.05);
  TEST_COMPARE(std::abs(flows[1].shear - 1.0), <, 0.01);
  TEST_COMPARE(flows[0].spread, <, 0.09);
  TEST_COMPARE(flows[1].spread, <, 0.08);
}

TEUCHOS_UNIT_TEST(poiseuille, without_the_viscous_residual_the_flow_bypasses_as_predicted) {
  for (const int n : {2, 4}) {
    const Flow flow = flow_on(n, "linear");
    TEST_FLOATING_EQUALITY(flow.bypass(), flow.predicted, 0.1);
  }
  const Flow weaker = flow_on(2, "linear", "12");
  TEST_FLOATING_EQUALITY(weaker.bypass(), weaker.predicted / 3.0, 0.2);
}

/// γ̇ where the shear stress of a fluid that thins is μ(γ̇)γ̇ = stress.
double shear_rate_at(double stress) {
  double low = 0.0, high = stress / 0.05;
  for (int k = 0; k < 100; ++k) {
    const double rate = 0.5 * (low + high);
    const double mu = 0.05 + 0.45 * std::pow(1.0 + std::pow(120.0 * rate, 2.0), -0.3);
    (mu * rate < stress ? low : high) = rate;
  }
  return low;
}

/// Of Carreau's law, whose viscosity falls from 0.5 in the middle to 0.14 at the wall: the shear
/// stress is G r/2 with any law, so that Q = π ∫ γ̇ r² dr.
const Fluid carreau{entry("law", "string", "carreau-yasuda") +
                        entry("viscosity", "double", "0.05") +
                        entry("viscosity at rest", "double", "0.5") +
                        entry("time constant", "double", "120") + entry("power", "double", "0.4"),
                    [](double G) {
                      const int n = 2000;
                      double sum = 0.0;
                      for (int k = 0; k < n; ++k) {
                        const double r = (k + 0.5) * R / n;
                        sum += shear_rate_at(0.5 * G * r) * r * r * R / n;
                      }
                      return pi * sum;
                    }};

TEUCHOS_UNIT_TEST(poiseuille, a_fluid_that_thins_has_its_own_profile) {
  double last = 0.0;
  for (const int n : {2, 4}) {
    const Flow flow = flow_on(n, "viscous", "4", carreau);
    out << "n " << n << ": inflow " << flow.inflow << ", developed flow " << flow.developed
        << ", wall shear stress " << flow.shear << "\n";
    const double error = std::abs(flow.developed - 1.0);
    if (n > 2) {
      TEST_COMPARE(verify::order(last, error), >=, 1.8);
      TEST_COMPARE(error, <, 0.035);
      TEST_COMPARE(std::abs(flow.inflow - 1.0), <, 0.02);
      TEST_COMPARE(std::abs(flow.shear - 1.0), <, 0.01);
    }
    last = error;
  }
}

}  // namespace
