#include <Teuchos_UnitTestHarness.hpp>

#include "tunica/boundary/surface_geometry.hpp"
#include "tunica/boundary/surface_terms.hpp"
#include "tunica/stepping/bdf2.hpp"
#include "unit/fields/small_tube.hpp"

namespace {

using namespace tunica;
using test::SmallTube;

constexpr double stiffness = 3.0, damping = 0.7;

/// The outer surface of a tube's wall on a bed.
struct Bedded {
  SmallTube tube;
  boundary::SurfaceTerms terms;
  stepping::Bdf2 scheme{2};
  std::vector<Vec3> past;

  explicit Bedded(const std::string& direction, double pressure = 0.0)
      : terms({condition(direction, pressure)}, boundary::wall_conditions(), tube.wall) {
    scheme.set_step_size(0.5, 0.4);
    terms.follow(scheme);
    for (const int vertex : tube.wall.vertex)
      past.push_back({test::scatter(vertex), 0.1, test::scatter(7.0 * vertex)});
  }

  static boundary::Condition condition(const std::string& direction, double pressure) {
    Teuchos::ParameterList list;
    list.set("condition", "support").set("direction", direction).set("pressure", pressure);
    list.set("stiffness", stiffness).set("damping", damping);
    boundary::condition_table("", boundary::wall_conditions()).resolve(list, "outer", "");
    return {"outer", list};
  }

  algebra::BlockVector residual(const algebra::BlockVector& x, fields::BlockOperator* K) const {
    const fields::FieldMesh& mesh = tube.wall;
    const std::vector<Vec3> d = fields::ghosted_vectors(mesh, x[0]);
    std::vector<Vec3> v(d.size());
    for (std::size_t a = 0; a < d.size(); ++a) v[a] = scheme.rate() * (d[a] - past[a]);
    const boundary::Surroundings s{&mesh, &mesh.x, &mesh.x, &d, &v, 0.0, 0.0};
    const assembly::Constraints fixed(mesh.n_nodes());
    assembly::NodalResidual R(mesh);
    if (K == nullptr) {
      terms.add(s, R, nullptr);
    } else {
      assembly::BlockAssembler assembler(*K, fixed);
      terms.add(s, R, &assembler);
      assembler.finish();
    }
    algebra::BlockVector F = fields::zero_vector(mesh);
    R.store(fixed, F);
    return F;
  }
};

TEUCHOS_UNIT_TEST(support, its_jacobian_is_exact_in_any_direction) {
  for (const char* direction : {"normal", "all"}) {
    const Bedded bedded(direction);
    const auto x = test::scattered(bedded.tube.wall, 1), v = test::scattered(bedded.tube.wall, 2);
    fields::BlockOperator K(bedded.tube.wall);
    algebra::BlockVector sum = K.zero(), Kv = K.zero();
    sum.assign(x);
    test::add(1.0, v, sum);
    algebra::BlockVector difference = bedded.residual(sum, nullptr);
    test::add(-1.0, bedded.residual(x, &K), difference);
    K.apply(v, Kv);
    TEST_COMPARE(test::norm(Kv), >, 0.1);
    TEST_COMPARE(test::relative_difference(Kv, difference), <, 1e-13);  // it is affine
  }
}

TEUCHOS_UNIT_TEST(support, of_all_directions_it_bears_the_area_times_the_displacement) {
  const Bedded bedded("all");
  const fields::FieldMesh& mesh = bedded.tube.wall;
  const Vec3 d{0.1, -0.2, 0.4}, v{0.3, 0.0, -0.5};
  const std::vector<Vec3> all_d(mesh.n_nodes(), d), all_v(mesh.n_nodes(), v);
  const boundary::Surroundings s{&mesh, &mesh.x, &mesh.x, &all_d, &all_v, 0.0, 0.0};
  const double A = boundary::surface_geometry(mesh, bedded.tube.surface("outer")).area;
  std::map<std::string, double> found;
  bedded.terms.observe_whole(s, found);
  TEST_FLOATING_EQUALITY(found.at("support_energy_outer_kPa_mm3"), 0.5 * stiffness * A * dot(d, d),
                         1e-12);
  TEST_FLOATING_EQUALITY(found.at("support_power_outer_kPa_mm3_per_ms"), damping * A * dot(v, v),
                         1e-12);
  const Vec3 mine = bedded.terms.load(s, bedded.tube.surface("outer"));  // on owned nodes
  for (int i = 0; i < 3; ++i) {
    const double expected = -A * (stiffness * d[i] + damping * v[i]);
    TEST_FLOATING_EQUALITY(found.at(std::string("support_force_outer_") + "xyz"[i] + "_mN"),
                           expected, 1e-12);
    TEST_FLOATING_EQUALITY(global_sum(*mesh.comm, mine[i]), expected, 1e-12);
  }
}

TEUCHOS_UNIT_TEST(support, along_the_normal_a_tube_slides_and_turns_freely) {
  const Bedded bedded("normal");
  const fields::FieldMesh& mesh = bedded.tube.wall;
  std::vector<Vec3> slide(mesh.n_nodes(), Vec3{0, 0, 1});
  const boundary::Surroundings s{&mesh, &mesh.x, &mesh.x, &slide, &slide, 0.0, 0.0};
  std::map<std::string, double> found;
  bedded.terms.observe_whole(s, found);
  TEST_COMPARE(found.at("support_energy_outer_kPa_mm3"), <, 1e-25);
  // inflated by one: k A/2, the corners of the polygon being cut by cos²(π/8)
  for (int a = 0; a < mesh.n_nodes(); ++a) {
    const Vec3& x = mesh.x[a];
    slide[a] = 1.0 / std::hypot(x[0], x[1]) * Vec3{x[0], x[1], 0.0};
  }
  bedded.terms.observe_whole(s, found);
  const double A = boundary::surface_geometry(mesh, bedded.tube.surface("outer")).area;
  const double c = std::cos(M_PI / 8.0);
  TEST_FLOATING_EQUALITY(found.at("support_energy_outer_kPa_mm3"), 0.5 * stiffness * A * c * c,
                         1e-12);
}

TEUCHOS_UNIT_TEST(support, the_pressure_outside_is_that_of_a_surface) {
  const Bedded with("all", 2.0), without("all");
  const fields::FieldMesh& mesh = with.tube.wall;
  const auto x = fields::zero_vector(mesh);
  algebra::BlockVector F = with.residual(x, nullptr);
  test::add(-1.0, without.residual(x, nullptr), F);
  const auto area = boundary::nodal_areas(mesh, mesh.x, {with.tube.surface("outer")});
  const auto forces = fields::owned_vectors(mesh, F[0]);
  for (int a = 0; a < mesh.n_owned; ++a) TEST_COMPARE(norm(forces[a] - 2.0 * area[a]), <, 1e-13);
}

}  // namespace
