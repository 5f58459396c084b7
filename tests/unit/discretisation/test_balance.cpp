#include <Teuchos_UnitTestHarness.hpp>
#include <cmath>

#include "tunica/base/reduce.hpp"
#include "tunica/discretisation/balance.hpp"
#include "tunica/discretisation/fluid.hpp"
#include "tunica/discretisation/solid.hpp"
#include "tunica/kernels/deformation.hpp"
#include "unit/discretisation/few_tets.hpp"

namespace {

using namespace tunica;
using discretisation::Balance;

constexpr double rho = 1.06, dt = 0.5;

Balance summed(const Comm& comm, Balance balance) {
  balance.each([&](double& number) { number = global_sum(comm, number); });
  return balance;
}

Vec3 sum_of_nodes(const std::array<Vec3, 4>& v) { return v[0] + v[1] + v[2] + v[3]; }

/// ∫ u·v dV of linear fields.
double product(double V, const std::array<Vec3, 4>& u, const std::array<Vec3, 4>& v) {
  double products = dot(sum_of_nodes(u), sum_of_nodes(v));
  for (int a = 0; a < 4; ++a) products += dot(u[a], v[a]);
  return V / 20.0 * products;
}

double divergence_of(const Mat3& G) { return G[0][0] + G[1][1] + G[2][2]; }

/// A fluid under a pressure at one end, with a velocity below, in a step of a mesh that moves, at a
/// state that solves nothing.
struct AnyFlow {
  AnyFlow() : fluid(options(), few.field), past(test::scattered(few.field, 2)), x(past.space()) {
    fluid.start_from(past);
    fluid.begin_step(stepping::Clock(dt, 1));
    for (const int vertex : few.field.vertex)
      for (const int seed : {7, 9})
        (seed == 7 ? d : d_past)
            .push_back(0.03 * Vec3{test::scatter(4.0 * vertex + seed),
                                   test::scatter(4.0 * vertex + 1 + seed),
                                   test::scatter(4.0 * vertex + 2 + seed)});
    is_placed = fluid.set_domain(d, d_past).is_success();
    x = test::scattered(few.field, 3);
    fluid.prescribe(x);
    u = fields::ghosted_vectors(few.field, x[0]);
    u_old = fields::ghosted_vectors(few.field, past[0]);
    for (std::size_t a = 0; a < d.size(); ++a) w.push_back(1.0 / dt * (d[a] - d_past[a]));
  }

  static discretisation::FluidOptions options() {
    Teuchos::ParameterList list = test::fluid_list(rho, 0.05);
    list.set("regions", Teuchos::Array<std::string>(std::vector<std::string>{"block"}));
    list.set<std::string>("time scheme", "implicit euler");
    test::set_vector(test::condition(list, "z_low", "velocity"), "velocity", {0.3, 0.1, -0.2});
    test::condition(list, "x_low", "pressure")
        .set("pressure", 2.0)
        .set("backflow stabilisation", 0.2);
    return discretisation::fluid_options(test::resolved(list, problems::fluid_table()));
  }

  /// Sum over all elements of what do_one(T, u, u̇, w) gives.
  template <class DoOne>
  double sum(const DoOne& do_one) const {
    double all = 0.0;
    for (std::size_t e = 0; e < few.field.tets.size(); ++e) {
      if (!few.field.is_owned[e]) continue;
      const auto& nodes = few.field.tets[e];
      const auto at = assembly::gather(u, nodes);
      std::array<Vec3, 4> rate = assembly::gather(u_old, nodes);
      for (int a = 0; a < 4; ++a) rate[a] = 1.0 / dt * (at[a] - rate[a]);
      all += do_one(fluid.elements().geometry[e], at, rate, assembly::gather(w, nodes));
    }
    return global_sum(*few.field.comm, all);
  }

  test::FewTets few;
  discretisation::Fluid fluid;
  algebra::BlockVector past, x;
  std::vector<Vec3> d, d_past, u, u_old, w;
  bool is_placed = false;
};

TEUCHOS_UNIT_TEST(balance, what_passes_the_boundary_of_a_fluid_is_its_divergence) {
  AnyFlow flow;
  TEST_ASSERT(flow.is_placed);
  const Balance b = summed(*flow.few.field.comm, flow.fluid.balance(flow.x));
  const auto of_u = [](const kernels::Tet4& T, const auto& u, const auto&, const auto&) {
    return T.volume * divergence_of(kernels::gradient(T, u));
  };
  const auto of_w = [](const kernels::Tet4& T, const auto&, const auto&, const auto& w) {
    return T.volume * divergence_of(kernels::gradient(T, w));
  };
  TEST_FLOATING_EQUALITY(b.net_outflow, flow.sum(of_u), 1e-12);
  TEST_FLOATING_EQUALITY(b.swept, flow.sum(of_w), 1e-12);
  TEST_COMPARE(b.throughput, >, 0.5 * std::abs(b.net_outflow));
}

// ∫ ρ (u̇ + (c·∇)u) dV, linear on an element
TEUCHOS_UNIT_TEST(balance, all_forces_on_a_fluid_are_its_inertia) {
  AnyFlow flow;
  const Balance b = summed(*flow.few.field.comm, flow.fluid.balance(flow.x));
  const Vec3 forces = b.loads + b.reactions + b.interface + b.error;
  for (int i = 0; i < 3; ++i) {
    const auto inertia = [i](const kernels::Tet4& T, const auto& u, const auto& rate,
                             const auto& w) {
      const Vec3 c = 0.25 * (sum_of_nodes(u) - sum_of_nodes(w));
      return rho * T.volume * (0.25 * sum_of_nodes(rate) + kernels::gradient(T, u) * c)[i];
    };
    TEST_FLOATING_EQUALITY(forces[i], flow.sum(inertia), 1e-11);
    const auto momentum = [i](const kernels::Tet4& T, const auto& u, const auto&, const auto&) {
      return 0.25 * rho * T.volume * sum_of_nodes(u)[i];
    };
    TEST_FLOATING_EQUALITY(b.momentum[i], flow.sum(momentum), 1e-12);
  }
}

// ∮ ρ u (c·n) da = ∫ ρ ((c·∇)u + u div c) dV
TEUCHOS_UNIT_TEST(balance, fluid_takes_its_momentum_along) {
  AnyFlow flow;
  const Balance b = summed(*flow.few.field.comm, flow.fluid.balance(flow.x));
  for (int i = 0; i < 3; ++i) {
    const auto carried = [i](const kernels::Tet4& T, const auto& u, const auto&, const auto& w) {
      const Mat3 G = kernels::gradient(T, u);
      const Vec3 c = 0.25 * (sum_of_nodes(u) - sum_of_nodes(w));
      const double div = divergence_of(G) - divergence_of(kernels::gradient(T, w));
      return rho * T.volume * ((G * c)[i] + div * 0.25 * sum_of_nodes(u)[i]);
    };
    TEST_FLOATING_EQUALITY(b.outflow[i], flow.sum(carried), 1e-11);
  }
}

// Σ powers = ∫ ρ u̇·u dV + ½ρ ∫ |u|² div w dV, whatever the state
TEUCHOS_UNIT_TEST(balance, all_powers_of_a_fluid_change_its_kinetic_energy) {
  AnyFlow flow;
  const Balance b = summed(*flow.few.field.comm, flow.fluid.balance(flow.x));
  const discretisation::Observables of = flow.fluid.observe(flow.x);
  const auto power = [&of](const std::string& name) {
    return test::observed(of, name + "_kPa_mm3_per_ms");
  };
  const double given = b.load_power + b.reaction_power + b.interface_power + b.power_error +
                       power("kinetic_inflow") + power("divergence_power") -
                       power("viscous_power") - power("stabilisation_power");
  const auto change = [](const kernels::Tet4& T, const auto& u, const auto& rate, const auto& w) {
    return rho * (product(T.volume, rate, u) +
                  0.5 * divergence_of(kernels::gradient(T, w)) * product(T.volume, u, u));
  };
  TEST_FLOATING_EQUALITY(given, flow.sum(change), 1e-11);
  TEST_COMPARE(std::abs(b.reaction_power), >, 0.0);
  TEST_COMPARE(power("backflow_power"), >, 0.0);
  TEST_FLOATING_EQUALITY(b.load_power, power("traction_power") - power("backflow_power"), 1e-12);
}

/// A wall pulled at one end, held at the other, from rest.
Teuchos::ParameterList pulled_wall() {
  Teuchos::ParameterList list;
  list.sublist("Layers").sublist("block").set("density", rho).set("bulk modulus", 500.0);
  list.set<std::string>("time scheme", "implicit euler").set("volumetric stabilisation", 0.0);
  test::condition(list, "x_low", "clamped");
  test::set_vector(test::condition(list, "x_high", "traction"), "traction", {2.0, 0.5, 0.1});
  test::set_vector(list, "body force", {0.3, -0.2, 0.1});
  return test::resolved(list, problems::solid_table());
}

// ∫ ρ a dV = Σ V/4 ρ Σ d/Δt²,   ∫ J − 1 + p/κ dV
TEUCHOS_UNIT_TEST(balance, forces_on_a_wall_are_its_inertia_and_its_volume_is_kept_up_to_an_error) {
  const test::FewTets few;
  const fields::FieldMesh& mesh = few.field;
  discretisation::Solid wall(discretisation::solid_options(pulled_wall()), mesh, {});
  wall.begin_step(stepping::Clock(dt, 1));
  const std::vector<Vec3> from_fluid(mesh.n_owned, Vec3{0.01, 0.02, -0.03});
  wall.set_nodal_force(from_fluid);
  algebra::BlockVector x = test::scattered(mesh, 3, 0.02);
  wall.prescribe(x);
  const Balance b = summed(*mesh.comm, wall.balance(x));
  const std::vector<Vec3> d = fields::ghosted_vectors(mesh, x[0]);
  const std::vector<double> p = fields::ghosted_scalars(mesh, x[1]);
  Vec3 inertia{};
  double error = 0.0, volume = 0.0, undeformed = 0.0, counted = 0.0;
  for (std::size_t e = 0; e < mesh.tets.size(); ++e) {
    if (!mesh.is_owned[e]) continue;
    const auto T = kernels::make_tet4(assembly::gather(mesh.x, mesh.tets[e]));
    const auto de = assembly::gather(d, mesh.tets[e]);
    const auto pe = assembly::gather(p, mesh.tets[e]);
    const double J = det(kernels::deformation_gradient(T, de));
    inertia += 0.25 * rho * T.volume / (dt * dt) * sum_of_nodes(de);
    error += T.volume * (J - 1.0 + 0.25 * (pe[0] + pe[1] + pe[2] + pe[3]) / 500.0);
    volume += T.volume * J;
    undeformed += T.volume;
    counted += 1.0;
  }
  const Vec3 forces = b.loads + b.reactions + b.interface + b.error;
  for (int i = 0; i < 3; ++i)
    TEST_FLOATING_EQUALITY(forces[i], global_sum(*mesh.comm, inertia[i]), 1e-11);
  const double mass = rho * global_sum(*mesh.comm, undeformed);
  TEST_FLOATING_EQUALITY(b.loads[0], 2.0 * 0.3 * 0.4 + mass * 0.3, 1e-12);
  TEST_FLOATING_EQUALITY(b.loads[1], 0.5 * 0.3 * 0.4 - mass * 0.2, 1e-12);
  TEST_FLOATING_EQUALITY(b.interface[2], -0.03 * mesh.node_map->getGlobalNumElements(), 1e-12);
  TEST_FLOATING_EQUALITY(b.volume_error, global_sum(*mesh.comm, error), 1e-12);
  TEST_FLOATING_EQUALITY(b.volume, global_sum(*mesh.comm, volume), 1e-12);
  double in_bins = 0.0;
  for (const double count : b.volume_ratios) in_bins += count;
  TEST_EQUALITY(in_bins, global_sum(*mesh.comm, counted));
}

TEUCHOS_UNIT_TEST(balance, quantiles_of_volume_ratios_are_known_to_four_per_cent_of_the_change) {
  std::vector<double> counts(discretisation::volume_ratio_bins);
  const auto ratio = [](int i) { return 1.0 + 1e-3 * (i - 49.5); };  // 0.9505 to 1.0495
  for (int i = 0; i < 100; ++i) counts[discretisation::bin_of_volume_ratio(ratio(i))] += 1.0;
  for (const int i : {0, 10, 80, 98}) {
    const double found = discretisation::quantile_of_volume_ratio(counts, 0.01 * (i + 0.5));
    TEST_COMPARE(std::abs(found - ratio(i)), <, 0.04 * std::abs(ratio(i) - 1.0) + 1e-3);
  }
  TEST_COMPARE(std::abs(discretisation::quantile_of_volume_ratio(counts, 0.5) - 1.0), <, 1e-3);
  for (const double J : {0.1, 1.0, 1.0 + 1e-9, 9.0}) {
    std::vector<double> one(discretisation::volume_ratio_bins);
    one[discretisation::bin_of_volume_ratio(J)] = 1.0;
    const double found = discretisation::quantile_of_volume_ratio(one, 0.5);
    TEST_COMPARE(std::abs(found - J), <, 0.04 * std::abs(J - 1.0) + 1e-7);
  }
  TEST_ASSERT(std::isnan(discretisation::quantile_of_volume_ratio(
      std::vector<double>(discretisation::volume_ratio_bins), 0.5)));
}

}  // namespace
