#include <Teuchos_UnitTestHarness.hpp>

#include "tunica/assembly/gather.hpp"
#include "tunica/boundary/surface_geometry.hpp"
#include "tunica/boundary/surface_terms.hpp"
#include "unit/fields/small_tube.hpp"

namespace {

using namespace tunica;
using boundary::Condition;
using boundary::ConditionEntry;
using boundary::SurfaceTerms;
using test::SmallTube;

/// As one adds a term: a bed of springs, R[a] += k A/3 u[a], of the stiffness that the list gives.
class Springs final : public boundary::FaceLoad {
public:
  explicit Springs(double k) : stiffness_(k) {}

  void add(const boundary::Surroundings& s, const fields::Face& face, assembly::NodalResidual& R,
           assembly::BlockAssembler* K) const override {
    const double k =
        stiffness_ / 3.0 * norm(kernels::area_normal(assembly::gather(*s.position, face.nodes)));
    kernels::SurfaceResidual Re;
    kernels::SurfaceJacobian Ke{};
    for (int a = 0; a < 3; ++a) {
      Re.u[a] = k * (*s.u)[face.nodes[a]];
      for (int i = 0; i < 3; ++i) Ke.A[a][a][i][i] = k;
    }
    R.add(*s.mesh, face, Re);
    if (K != nullptr) K->add(face, Ke);
  }

private:
  double stiffness_;
};

/// As one adds a term of the whole surface with a memory: R[a] += s Q³ A_a for the flow Q = Σ
/// A_a·u_a, where s is the sum of the flows of the steps accepted.
class Memory final : public boundary::WholeLoad, public boundary::Remembering {
public:
  explicit Memory(int surface) : surface_(surface) {}

  int rank() const override { return 1; }
  void add_whole(const boundary::Surroundings& s, assembly::NodalResidual& R,
                 assembly::BlockAssembler* K) const override {
    const auto area = boundary::nodal_areas(*s.mesh, *s.position, {surface_});
    const double Q = flow(s);
    for (std::size_t a = 0; a < area.size(); ++a) R.u[a] += sum_ * Q * Q * Q * area[a];
    if (K != nullptr) K->add(3.0 * sum_ * Q * Q, area, area);
  }
  void end_step(const boundary::Surroundings& s) override { sum_ += flow(s); }
  std::vector<double> state() const override { return {sum_}; }
  void restore(const std::vector<double>& state) override { sum_ = state[0]; }

private:
  double flow(const boundary::Surroundings& s) const {
    const auto area = boundary::nodal_areas(*s.mesh, *s.position, {surface_});
    double mine = 0.0;
    for (std::size_t a = 0; a < area.size(); ++a) mine += dot(area[a], (*s.u)[a]);
    return global_sum(*s.mesh->comm, mine);
  }

  int surface_;
  double sum_ = 0.0;
};

/// Those of a fluid, the springs and the memory.
std::vector<ConditionEntry> with_springs() {
  params::Table table;
  table.number("stiffness", 1.0, params::positive(), "kPa/mm", "");
  std::vector<ConditionEntry> all = boundary::fluid_conditions();
  all.push_back({boundary::Field::fluid, "springs", table,
                 [](const Teuchos::ParameterList& list, const fields::FieldMesh&, int) {
                   boundary::Terms terms;
                   terms.push_back(std::make_unique<Springs>(list.get<double>("stiffness")));
                   return terms;
                 },
                 boundary::drives_nothing});
  all.push_back({boundary::Field::fluid, "memory", params::Table(),
                 [](const Teuchos::ParameterList&, const fields::FieldMesh&, int surface) {
                   return boundary::terms(std::make_unique<Memory>(surface));
                 },
                 boundary::drives_nothing});
  return all;
}

Condition condition(const std::string& surface, const std::string& kind) {
  Teuchos::ParameterList list;
  list.set("condition", kind);
  if (kind == "velocity")
    list.set("velocity", Teuchos::Array<double>(std::vector<double>{1, 2, 3}));
  boundary::condition_table("", with_springs()).resolve(list, surface, "");
  return {surface, list};
}

TEUCHOS_UNIT_TEST(surface_terms, every_condition_says_what_it_drives_a_vessel_by) {
  for (const auto& all : {boundary::fluid_conditions(), boundary::wall_conditions()})
    for (const ConditionEntry& entry : all) {
      out << entry.name << "\n";
      TEST_ASSERT(static_cast<bool>(entry.drive));
    }
}

TEUCHOS_UNIT_TEST(surface_terms, where_surfaces_meet_the_stronger_condition_holds) {
  const SmallTube tube;
  SurfaceTerms terms({condition("inlet", "velocity"), condition("interface", "no slip")},
                     boundary::fluid_conditions(), tube.fluid);
  const int inlet = tube.surface("inlet"), side = tube.surface("interface");
  TEST_ASSERT(!terms.is_natural(inlet) && terms.is_natural(tube.surface("outlet")));
  Vector u(tube.fluid.vector_map);
  u.putScalar(7.0);
  const std::vector<Vec3> zero(tube.fluid.n_nodes());
  terms.impose({&tube.fluid, &tube.fluid.x, &tube.fluid.x, &zero, &zero, 1.0, 0.0}, u);
  const auto values = fields::owned_vectors(tube.fluid, u);
  for (int a = 0; a < tube.fluid.n_owned; ++a) {
    const bool is_held = tube.fluid.is_on(a, inlet) || tube.fluid.is_on(a, side);
    for (int i = 0; i < 3; ++i) TEST_EQUALITY(terms.constraints().is_fixed(a, i), is_held);
    const Vec3 expected = tube.fluid.is_on(a, side)    ? Vec3{0, 0, 0}
                          : tube.fluid.is_on(a, inlet) ? Vec3{1, 2, 3}
                                                       : Vec3{7, 7, 7};
    TEST_EQUALITY(norm(values[a] - expected), 0.0);
  }
}

Condition held(const std::string& components) {
  Teuchos::ParameterList list;
  list.set("condition", "held");
  list.set("components", Teuchos::Array<std::string>(Teuchos::tuple(components)));
  boundary::condition_table("", boundary::fluid_conditions()).resolve(list, "inlet", "");
  return {"inlet", list};
}

TEUCHOS_UNIT_TEST(surface_terms, what_has_velocities_at_places_does_not_stretch_with_its_rim) {
  const SmallTube tube;
  const auto keeps_place = [&](const std::vector<Condition>& conditions) {
    return SurfaceTerms(conditions, with_springs(), tube.fluid).keeps_place(tube.surface("inlet"));
  };
  TEST_ASSERT(keeps_place({condition("inlet", "no slip")}));
  TEST_ASSERT(keeps_place({condition("inlet", "velocity")}));
  TEST_ASSERT(keeps_place({held("x"), held("y"), held("z")}));
  TEST_ASSERT(!keeps_place({held("x"), held("y")}));
  TEST_ASSERT(!keeps_place({condition("inlet", "springs")}));
  TEST_ASSERT(!keeps_place({}));
}

TEUCHOS_UNIT_TEST(surface_terms, a_term_of_ones_own_adds_to_residual_and_jacobian) {
  const SmallTube tube;
  const SurfaceTerms terms({condition("outlet", "springs")}, with_springs(), tube.fluid);
  TEST_ASSERT(terms.is_natural(tube.surface("outlet")));
  assembly::Constraints fixed(tube.fluid.n_nodes());
  fields::BlockOperator K(tube.fluid);
  assembly::NodalResidual R(tube.fluid);
  const auto x = test::scattered(tube.fluid, 1);
  const std::vector<Vec3> u = fields::ghosted_vectors(tube.fluid, x[0]), w(u.size());
  {
    assembly::BlockAssembler assembler(K, fixed);
    terms.add({&tube.fluid, &tube.fluid.x, &tube.fluid.x, &u, &w, 1.0, 0.0}, R, &assembler);
    assembler.finish();
  }
  algebra::BlockVector F = K.zero(), Kx = K.zero();
  R.store(fixed, F);
  K.apply(x, Kx);
  TEST_COMPARE(test::norm(F), >, 0.1);
  TEST_COMPARE(test::relative_difference(Kx, F), <, 1e-14);  // it is linear
}

TEUCHOS_UNIT_TEST(surface_terms, several_conditions_hold_on_one_surface) {
  const SmallTube tube;
  const int outlet = tube.surface("outlet");
  Teuchos::ParameterList surfaces;
  surfaces.sublist("outlet").setParameters(condition("outlet", "springs").list);
  surfaces.sublist("plug").setParameters(condition("plug", "velocity").list);
  surfaces.sublist("plug").set("surface", "outlet");
  const auto conditions = boundary::conditions_of(surfaces);
  TEST_EQUALITY(conditions[1].surface, "outlet");
  const SurfaceTerms both(conditions, with_springs(), tube.fluid);
  TEST_ASSERT(both.prescribes(outlet, 0) && !both.is_natural(outlet));
  TEST_ASSERT(both.has_condition(outlet, "springs") && both.has_condition(outlet, "velocity"));
  TEST_ASSERT(!both.has_condition(tube.surface("inlet")));

  const SurfaceTerms one({conditions[0]}, with_springs(), tube.fluid);
  const auto x = test::scattered(tube.fluid, 1);
  const std::vector<Vec3> u = fields::ghosted_vectors(tube.fluid, x[0]), w(u.size());
  const boundary::Surroundings s{&tube.fluid, &tube.fluid.x, &tube.fluid.x, &u, &w, 1.0, 0.0};
  TEST_COMPARE(norm(one.load(s, outlet)), >, 0.0);
  TEST_EQUALITY(norm(one.load(s, outlet) - both.load(s, outlet)), 0.0);
}

TEUCHOS_UNIT_TEST(surface_terms, a_term_of_a_whole_surface_has_an_exact_jacobian_and_a_state) {
  const SmallTube tube;
  SurfaceTerms terms({condition("outlet", "memory"), condition("inlet", "memory")}, with_springs(),
                     tube.fluid);
  TEST_EQUALITY(terms.rank(), 2);
  const std::vector<Vec3> w(tube.fluid.n_nodes());
  const auto at = [&](const std::vector<Vec3>& u) {
    return boundary::Surroundings{&tube.fluid, &tube.fluid.x, &tube.fluid.x, &u, &w, 1.0, 0.0};
  };
  const std::vector<Vec3> uniform(tube.fluid.n_nodes(), Vec3{0, 0, 0.5});
  terms.end_step(at(uniform));
  fields::State state;
  terms.save(state);
  TEST_FLOATING_EQUALITY(state.number_list("memory at outlet").at(0),
                         -state.number_list("memory at inlet").at(0), 1e-12);

  assembly::Constraints fixed(tube.fluid.n_nodes());
  const auto residual = [&](const algebra::BlockVector& x, fields::BlockOperator* K) {
    const std::vector<Vec3> u = fields::ghosted_vectors(tube.fluid, x[0]);
    assembly::NodalResidual R(tube.fluid);
    if (K != nullptr) {
      assembly::BlockAssembler assembler(*K, fixed);
      terms.add(at(u), R, &assembler);
      assembler.finish();
    } else {
      terms.add(at(u), R, nullptr);
    }
    algebra::BlockVector F = fields::zero_vector(tube.fluid);
    R.store(fixed, F);
    return F;
  };
  fields::BlockOperator K(tube.fluid);
  K.make_low_rank(terms.rank());
  const auto x = test::scattered(tube.fluid, 1), v = test::scattered(tube.fluid, 2);
  residual(x, &K);
  algebra::BlockVector plus = K.zero(), minus = K.zero(), Kv = K.zero();
  plus.assign(x);
  minus.assign(x);
  test::add(1e-5, v, plus);
  test::add(-1e-5, v, minus);
  algebra::BlockVector quotient = residual(plus, nullptr);
  test::add(-1.0, residual(minus, nullptr), quotient);
  for (int b = 0; b < 2; ++b) quotient[b].scale(0.5 / 1e-5);
  K.apply(v, Kv);
  TEST_COMPARE(test::norm(Kv), >, 1e-6);
  TEST_COMPARE(test::relative_difference(Kv, quotient), <, 1e-7);

  const auto before = residual(x, nullptr);
  terms.end_step(at(uniform));  // changes it, and back
  TEST_COMPARE(test::relative_difference(residual(x, nullptr), before), >, 0.5);
  TEST_EQUALITY(terms.restore(state), "");
  TEST_EQUALITY(test::relative_difference(residual(x, nullptr), before), 0.0);
}

}  // namespace
