#include <Teuchos_UnitTestHarness.hpp>

#include "tunica/base/error.hpp"
#include "tunica/boundary/surface_geometry.hpp"
#include "tunica/boundary/surface_terms.hpp"
#include "tunica/stepping/bdf2.hpp"
#include "tunica/stepping/implicit_euler.hpp"
#include "unit/fields/small_tube.hpp"

namespace {

using namespace tunica;
using boundary::Condition;
using boundary::SurfaceTerms;
using test::SmallTube;

Condition windkessel(const std::map<std::string, double>& values) {
  Teuchos::ParameterList list;
  list.set("condition", "windkessel");
  for (const auto& [key, value] : values) list.set(key, value);
  boundary::condition_table("", boundary::fluid_conditions()).resolve(list, "outlet", "");
  return {"outlet", list};
}

std::map<std::string, double> resistances(double proximal, double capacitance, double distal) {
  return {{"proximal resistance", proximal},
          {"capacitance", capacitance},
          {"distal resistance", distal},
          {"distal pressure", 1.5},
          {"initial pressure", 9.0}};
}

/// The outlet of a tube through which the fluid moves along the axis.
struct Outlet {
  SmallTube tube;
  SurfaceTerms terms;
  std::vector<Vec3> u, w;
  double area;

  explicit Outlet(const std::map<std::string, double>& values) : Outlet(windkessel(values)) {}
  explicit Outlet(const Condition& condition)
      : terms({condition}, boundary::fluid_conditions(), tube.fluid), u(tube.fluid.n_nodes()),
        w(tube.fluid.n_nodes()),
        area(boundary::surface_geometry(tube.fluid, tube.surface("outlet")).area) {}

  boundary::Surroundings with_flow(double Q) {
    for (Vec3& v : u) v = {0.3, -0.2, Q / area};  // across the axis nothing leaves
    return {&tube.fluid, &tube.fluid.x, &tube.fluid.x, &u, &w, 1.0, 0.0};
  }
  double pressure(double Q) {
    std::map<std::string, double> found;
    terms.observe_whole(with_flow(Q), found);
    return found.at("pressure_outlet_kPa");
  }
  double stored(double Q) {
    std::map<std::string, double> found;
    terms.observe_whole(with_flow(Q), found);
    return found.at("stored_pressure_outlet_kPa");
  }
};

TEUCHOS_UNIT_TEST(windkessel, without_capacitance_it_is_a_resistance) {
  Outlet outlet(resistances(2.0, 0.0, 16.0));
  stepping::ImplicitEuler scheme(1);
  scheme.set_step_size(0.5);
  outlet.terms.follow(scheme);
  for (const double Q : {0.3, -0.1, 2.0}) {
    outlet.terms.begin_step();
    TEST_FLOATING_EQUALITY(outlet.pressure(Q), 1.5 + 18.0 * Q, 1e-12);
    outlet.terms.end_step(outlet.with_flow(Q));
  }
}

TEUCHOS_UNIT_TEST(windkessel, it_starts_as_its_mean_flow_would_leave_it) {
  auto values = resistances(2.0, 10.0, 16.0);
  values["mean flow"] = 0.4;
  TEST_THROW(windkessel(values), Error);  // and at the initial pressure
  values["initial pressure"] = 0.0;
  Outlet outlet(values);
  stepping::ImplicitEuler scheme(1);
  scheme.set_step_size(0.5);
  outlet.terms.follow(scheme);
  outlet.terms.begin_step();
  TEST_FLOATING_EQUALITY(outlet.stored(0.4), 1.5 + 16.0 * 0.4, 1e-13);  // and stays there
}

TEUCHOS_UNIT_TEST(windkessel, under_constant_flow_it_fills_as_implicit_euler_has_it) {
  const double Rp = 2.0, C = 10.0, Rd = 16.0, dt = 40.0, Q = 0.4;
  Outlet outlet(resistances(Rp, C, Rd));
  stepping::ImplicitEuler scheme(1);
  outlet.terms.follow(scheme);
  TEST_EQUALITY(outlet.stored(Q), 9.0);  // before all steps
  scheme.set_step_size(dt);
  const double steady = 1.5 + Rd * Q;
  for (int n = 1; n <= 5; ++n) {
    outlet.terms.begin_step();
    outlet.terms.begin_step();  // again, as a coupled step may
    const double expected = steady + (9.0 - steady) * std::pow(1.0 + dt / (Rd * C), -n);
    TEST_FLOATING_EQUALITY(outlet.stored(Q), expected, 1e-13);
    TEST_FLOATING_EQUALITY(outlet.pressure(Q), Rp * Q + expected, 1e-13);
    outlet.pressure(7.0 * Q);  // looking leaves no trace
    outlet.terms.end_step(outlet.with_flow(Q));
  }
}

TEUCHOS_UNIT_TEST(windkessel, any_time_scheme_moves_its_state) {
  Outlet outlet(resistances(0.0, 10.0, 16.0));
  stepping::Bdf2 scheme(1);
  outlet.terms.follow(scheme);
  const double dt = 8.0;
  scheme.set_step_size(dt, dt);
  double p = 9.0, before = 0.0;  // the scheme knows no more of the time before the first step
  for (const double Q : {0.4, 0.1, 0.9, -0.3}) {
    outlet.terms.begin_step();
    const double now = outlet.stored(Q);
    // C (3p − 4pⁿ⁻¹ + pⁿ⁻²)/2Δt = Q − (p − p_d)/R_d
    TEST_FLOATING_EQUALITY(10.0 * (3.0 * now - 4.0 * p + before) / (2.0 * dt) + 1.0,
                           Q - (now - 1.5) / 16.0 + 1.0, 1e-12);
    outlet.terms.end_step(outlet.with_flow(Q));
    before = p;
    p = now;
  }
}

TEUCHOS_UNIT_TEST(windkessel, what_a_moving_outlet_sweeps_does_not_pass_it) {
  Outlet outlet(resistances(2.0, 0.0, 16.0));
  stepping::ImplicitEuler scheme(1);
  scheme.set_step_size(0.5);
  outlet.terms.follow(scheme);
  outlet.terms.begin_step();
  for (Vec3& w : outlet.w) w = {0.0, 0.0, 0.1};
  TEST_FLOATING_EQUALITY(outlet.pressure(0.4), 1.5 + 18.0 * (0.4 - 0.1 * outlet.area), 1e-12);
}

TEUCHOS_UNIT_TEST(windkessel, its_power_is_that_of_its_pressure) {
  Outlet outlet(resistances(2.0, 10.0, 16.0));
  stepping::ImplicitEuler scheme(1);
  scheme.set_step_size(0.5);
  outlet.terms.follow(scheme);
  outlet.terms.begin_step();
  std::map<std::string, double> found;
  outlet.terms.observe_whole(outlet.with_flow(0.4), found);
  TEST_FLOATING_EQUALITY(found.at("traction_power_kPa_mm3_per_ms"),
                         -0.4 * found.at("pressure_outlet_kPa"), 1e-12);
}

TEUCHOS_UNIT_TEST(windkessel, its_jacobian_is_one_product_and_exact) {
  Outlet outlet(resistances(2.0, 10.0, 16.0));
  const fields::FieldMesh& mesh = outlet.tube.fluid;
  stepping::ImplicitEuler scheme(1);
  scheme.set_step_size(40.0);
  outlet.terms.follow(scheme);
  outlet.terms.begin_step();
  TEST_EQUALITY(outlet.terms.rank(), 1);
  assembly::Constraints fixed(mesh.n_nodes());
  for (int a = 0; a < mesh.n_nodes(); ++a)
    if (mesh.is_on(a, outlet.tube.surface("interface"))) fixed.fix_vector(a);
  const auto residual = [&](const algebra::BlockVector& x, fields::BlockOperator* K) {
    const std::vector<Vec3> u = fields::ghosted_vectors(mesh, x[0]);
    assembly::NodalResidual R(mesh);
    const boundary::Surroundings s{&mesh, &mesh.x, &mesh.x, &u, &outlet.w, 1.0, 0.0};
    if (K == nullptr) {
      outlet.terms.add(s, R, nullptr);
    } else {
      assembly::BlockAssembler assembler(*K, fixed);
      outlet.terms.add(s, R, &assembler);
      assembler.finish();
    }
    algebra::BlockVector F = fields::zero_vector(mesh);
    R.store(fixed, F);
    return F;
  };
  const auto free = [&](algebra::BlockVector x) {
    const auto values = x[0].getLocalViewHost(read_write);
    for (int a = 0; a < mesh.n_owned; ++a)
      for (int i = 0; i < 3 && !fixed.is_free(a); ++i) values(3 * a + i, 0) = 0.0;
    return x;
  };
  fields::BlockOperator K(mesh);
  K.make_low_rank(outlet.terms.rank());
  const auto x = free(test::scattered(mesh, 1)), v = free(test::scattered(mesh, 2));
  algebra::BlockVector sum = fields::zero_vector(mesh), Kv = fields::zero_vector(mesh);
  sum.assign(x);
  test::add(1.0, v, sum);
  algebra::BlockVector difference = residual(sum, nullptr);
  test::add(-1.0, residual(x, &K), difference);
  K.apply(v, Kv);
  TEST_COMPARE(test::norm(Kv), >, 1e-3);
  TEST_COMPARE(test::relative_difference(Kv, difference), <, 1e-11);  // it is affine
  K.apply(test::scattered(mesh, 2), Kv);  // columns of what is prescribed are gone too
  TEST_COMPARE(test::relative_difference(Kv, difference), <, 1e-11);
}

TEUCHOS_UNIT_TEST(windkessel, a_saved_state_goes_on_as_if_nothing_had_happened) {
  Outlet first(resistances(2.0, 10.0, 16.0)), second(resistances(2.0, 10.0, 16.0));
  stepping::Bdf2 scheme(1);
  scheme.set_step_size(8.0, 8.0);
  first.terms.follow(scheme);
  second.terms.follow(scheme);
  for (const double Q : {0.4, 0.1}) {
    first.terms.begin_step();
    first.terms.end_step(first.with_flow(Q));
  }
  fields::State state;
  first.terms.save(state);
  TEST_EQUALITY(state.number_list("windkessel at outlet").size(), 2);
  TEST_EQUALITY(second.terms.restore(state), "");
  for (const double Q : {0.9, -0.3}) {
    first.terms.begin_step();
    second.terms.begin_step();
    TEST_EQUALITY(first.pressure(Q), second.pressure(Q));
    first.terms.end_step(first.with_flow(Q));
    second.terms.end_step(second.with_flow(Q));
  }
  TEST_EQUALITY(second.terms.restore({}), "the windkessel at outlet begins anew");
  state.numbers["windkessel at outlet"].pop_back();
  TEST_THROW(second.terms.restore(state), Error);
}

TEUCHOS_UNIT_TEST(resistance, is_a_windkessel_of_one_element) {
  Teuchos::ParameterList list;
  list.set("condition", "resistance").set("resistance", 18.0).set("distal pressure", 1.5);
  boundary::condition_table("", boundary::fluid_conditions()).resolve(list, "outlet", "");
  Outlet outlet(boundary::Condition{"outlet", list});
  stepping::ImplicitEuler scheme(1);
  scheme.set_step_size(0.5);
  outlet.terms.follow(scheme);
  for (const double Q : {0.3, -0.1, 2.0}) {
    outlet.terms.begin_step();
    TEST_FLOATING_EQUALITY(outlet.pressure(Q), 1.5 + 18.0 * Q, 1e-12);
    outlet.terms.end_step(outlet.with_flow(Q));
  }
}

TEUCHOS_UNIT_TEST(windkessel, its_keys_are_checked) {
  auto values = resistances(2.0, 10.0, 16.0);
  values.erase("capacitance");
  TEST_THROW(windkessel(values), Error);
  values["capacitance"] = -1.0;
  TEST_THROW(windkessel(values), Error);
  values["capacitance"] = 1.0;
  values["resistance"] = 1.0;
  TEST_THROW(windkessel(values), Error);
}

}  // namespace
