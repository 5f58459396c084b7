// Strips that are pulled: the face at their end moves as one. Where nothing but the end holds them
// the deformation is homogeneous, F = diag(λx, λy, λz), which linear elements have exactly:
//
//   force / area = ∂Ψ/∂λx,   0 = ∂Ψ/∂λy   of   Ψ(λx, λy) at λz = 1/(λx λy)

#include <Teuchos_UnitTestHarness.hpp>

#include "field_of.hpp"
#include "tunica/base/error.hpp"
#include "tunica/mesh/block.hpp"
#include "tunica/problems/solid_problem.hpp"

namespace {

using namespace tunica;
using verify::entry;
using verify::sublist;

constexpr double width = 1.5, thickness = 0.5, length = 3.0;

/// The fibres lie in the plane of the strip, at an angle from y.
mesh::Mesh make_strip() {
  mesh::Mesh mesh = mesh::make_block({{length, width, thickness}, {6, 3, 2}, {0, 0}});
  mesh.tet_vectors = {{"along", std::vector<Vec3>(mesh.tets.size(), Vec3{1, 0, 0})},
                      {"across", std::vector<Vec3>(mesh.tets.size(), Vec3{0, 0, 1})}};
  return mesh;
}

const std::string neo_hookean = entry("law", "string", "neo-hookean") + entry("c10", "double", "6");
const std::string fibres = entry("law", "string", "holzapfel") + entry("c10", "double", "3") +
                           entry("c01", "double", "0") + entry("k1", "double", "2.4") +
                           entry("k2", "double", "0.8") + entry("fibre angle", "double", "40") +
                           entry("dispersion", "double", "0.1");

double energy_with_fibres(double x, double y) {
  const double a = x * x, b = y * y, I1 = a + b + 1.0 / (a * b);
  const double angle = 40.0 * std::acos(-1.0) / 180.0;
  const double e =
      0.1 * I1 + 0.7 * (a * std::pow(std::sin(angle), 2) + b * std::pow(std::cos(angle), 2)) - 1.0;
  const double of_fibres = e > 0.0 ? 2.4 / (2.0 * 0.8) * (std::exp(0.8 * e * e) - 1.0) : 0.0;
  return 1.5 * (I1 - 3.0) + 2.0 * of_fibres;
}

/// Nominal stress of a strip of fibres [kPa].
double stress_of_fibres(double stretch) {
  const double h = 1e-6;
  const auto slope = [&](double y) {
    return (energy_with_fibres(stretch, y + h) - energy_with_fibres(stretch, y - h)) / (2.0 * h);
  };
  double low = 0.3, high = 2.0;
  while (high - low > 1e-10) (slope(0.5 * (low + high)) > 0.0 ? high : low) = 0.5 * (low + high);
  return (energy_with_fibres(stretch + h, low) - energy_with_fibres(stretch - h, low)) / (2.0 * h);
}

double neo_hookean_stress(double stretch) { return 6.0 * (stretch - 1.0 / (stretch * stretch)); }

std::string held(const std::string& surface, const std::string& components) {
  return sublist(surface, entry("condition", "string", "held") +
                              entry("components", "Array(string)", "{" + components + "}"));
}
std::string vector(double x) {
  std::ostringstream text;
  text.precision(17);
  text << "{" << x << ", 0, 0}";
  return text.str();
}
const std::string end_as_one =
    entry("condition", "string", "moves as one") + entry("components", "Array(string)", "{x}");
/// The amplitude 0.5, 1 at the times 1, 2.
const std::string ramp = sublist("Amplitude", entry("kind", "string", "table") +
                                                  entry("times", "Array(double)", "{0, 2}") +
                                                  entry("values", "Array(double)", "{0, 1}"));

/// Held without forces that a homogeneous strip would not have.
std::string symmetric(const std::string& end) {
  return held("x_low", "x") + held("y_low", "y") + held("z_low", "z") + end;
}

Teuchos::ParameterList strip(const std::string& layer, const std::string& surfaces,
                             const std::string& solver = "gcr") {
  return verify::resolved(
      problems::solid_table(),
      entry("analysis", "string", "static") +
          sublist("Layers", sublist("block", layer + entry("bulk modulus", "double", "1e7"))) +
          sublist("Fibre Frame", entry("kind", "string", "mesh") +
                                     entry("axial vectors", "string", "along") +
                                     entry("radial vectors", "string", "across")) +
          sublist("Surfaces", surfaces) +
          sublist("Newton", entry("linear tolerance", "double", "1e-10")) +
          sublist("Linear Solver", entry("method", "string", solver)));
}

struct End {
  double displacement, force;  ///< means and sums along x
};

End pulled(const Teuchos::ParameterList& list, int steps = 2) {
  const fields::FieldMesh field = verify::field_of(make_strip());
  problems::SolidProblem wall(list, field);
  for (stepping::Clock clock(2.0 / steps, steps); !clock.is_done(); clock.advance()) {
    wall.begin_step(clock);
    const nonlinear::NewtonReport report = wall.solve();
    TUNICA_CHECK(report.is_converged, report.reason);
    wall.end_step();
  }
  End end{};
  for (const auto& o : wall.observe_surfaces({field.surface_index("x_high")})) {
    if (o.name == "mean_displacement_x_high_x_mm") end.displacement = o.value;
    if (o.name == "wall_force_x_high_x_mN") end.force = -o.value;  // what it takes from the wall
  }
  return end;
}

std::string moved_by(double displacement) {
  return sublist("x_high", entry("condition", "string", "moved") +
                               entry("components", "Array(string)", "{x}") +
                               entry("displacement", "Array(double)", vector(displacement)) + ramp);
}

TEUCHOS_UNIT_TEST(strip, face_that_is_moved_takes_the_force_of_the_closed_form) {
  for (const double stretch : {0.6, 1.3, 1.8}) {
    const End end = pulled(strip(neo_hookean, symmetric(moved_by((stretch - 1.0) * length))));
    TEST_FLOATING_EQUALITY(end.displacement, (stretch - 1.0) * length, 1e-9);
    TEST_FLOATING_EQUALITY(end.force, width * thickness * neo_hookean_stress(stretch), 1e-5);
  }
}

TEUCHOS_UNIT_TEST(strip, strip_of_dispersed_fibres_takes_the_force_of_the_closed_form) {
  for (const double stretch : {1.15, 1.4}) {
    const End end = pulled(strip(fibres, symmetric(moved_by((stretch - 1.0) * length))));
    TEST_FLOATING_EQUALITY(end.force, width * thickness * stress_of_fibres(stretch), 1e-4);
  }
}

TEUCHOS_UNIT_TEST(strip, face_that_moves_as_one_goes_where_force_and_traction_balance) {
  const double stretch = 1.5, force = width * thickness * neo_hookean_stress(stretch);
  const std::string by_force =
      sublist("x_high", end_as_one + entry("force", "Array(double)", vector(force)) + ramp);
  const std::string by_traction =
      sublist("x_high", end_as_one) +
      sublist("pull",
              entry("surface", "string", "x_high") + entry("condition", "string", "traction") +
                  entry("traction", "Array(double)", vector(force / (width * thickness))) + ramp);
  for (const std::string& end : {by_force, by_traction})
    for (const std::string solver : {"gcr", "direct"})
      TEST_FLOATING_EQUALITY(pulled(strip(neo_hookean, symmetric(end), solver)).displacement,
                             (stretch - 1.0) * length, 1e-5);
}

TEUCHOS_UNIT_TEST(strip, displacement_and_its_force_are_two_ways_to_one_clamped_strip) {
  const std::string clamped = sublist("x_low", entry("condition", "string", "clamped"));
  const auto pull = [&](const std::string& end) {
    Teuchos::ParameterList list = strip(neo_hookean, clamped + end);
    list.set("stabilisation residual", std::string("linear"));  // the other is settled to 1e-3
    return pulled(list, 4);
  };
  const End by_displacement = pull(moved_by(1.2));
  const std::string free = sublist(
      "x_high", end_as_one + entry("force", "Array(double)", vector(by_displacement.force)) + ramp);
  const End by_force = pull(free);
  TEST_FLOATING_EQUALITY(by_force.displacement, 1.2, 1e-7);
  TEST_FLOATING_EQUALITY(by_force.force, by_displacement.force, 1e-7);
}

/// Largest entry.
double size(const algebra::BlockVector& x, int block) { return x[block].normInf(); }

TEUCHOS_UNIT_TEST(strip, jacobian_of_faces_that_move_as_one_is_exact) {
  // y moves the members of a motion alike, as Newton's increments do
  const fields::FieldMesh field = verify::field_of(make_strip());
  const std::string pressed = sublist("load", entry("surface", "string", "x_high") +
                                                  entry("condition", "string", "pressure") +
                                                  entry("pressure", "double", "0.7"));
  const std::string ends =
      sublist("x_high", entry("condition", "string", "moves as one")) + pressed +
      sublist("x_low", entry("condition", "string", "moves as one") +
                           entry("components", "Array(string)", "{y}")) +
      sublist("side", entry("surface", "string", "x_low") + entry("condition", "string", "moved") +
                          entry("components", "Array(string)", "{x, z}") +
                          entry("displacement", "Array(double)", "{-0.3, 0, 0.1}"));
  problems::SolidProblem wall(strip(fibres, ends), field);
  wall.begin_step(stepping::Clock(2.0, 1));
  const int high = field.surface_index("x_high"), low = field.surface_index("x_low");
  const auto wave = [&](double at, algebra::BlockVector& x) {
    const auto u = x[0].getLocalViewHost(overwrite_all);
    const auto p = x[1].getLocalViewHost(overwrite_all);
    for (int a = 0; a < field.n_owned; ++a) {
      const Vec3& X = field.x[a];
      const double on = field.is_on(a, high) || field.is_on(a, low) ? 0.3 : std::sin(X[1] + X[0]);
      for (int i = 0; i < 3; ++i) u(3 * a + i, 0) = 0.1 * on * std::cos(at + i + X[0]);
      p(a, 0) = std::sin(at + X[2] + 2.0 * X[1]);
    }
  };
  algebra::BlockVector x(wall.space()), y(wall.space()), Ky(wall.space()), above(wall.space()),
      below(wall.space());
  wave(0.4, x);
  wave(1.7, y);
  TEST_ASSERT(wall.residual(x, above).is_success());
  wall.jacobian(x);
  wall.apply_jacobian(y, Ky);
  const double h = 1e-6;
  const auto residual_at = [&](double step, algebra::BlockVector& F) {
    algebra::BlockVector moved(wall.space());
    for (int b = 0; b < 2; ++b) moved[b].update(1.0, x[b], step, y[b], 0.0);
    TEST_ASSERT(wall.residual(moved, F).is_success());
  };
  residual_at(h, above);
  residual_at(-h, below);
  for (int b = 0; b < 2; ++b) {
    above[b].update(-1.0, below[b], 1.0);
    above[b].scale(0.5 / h);
    above[b].update(-1.0, Ky[b], 1.0);
    TEST_COMPARE(size(above, b), <, 1e-6 * size(Ky, b));
  }
}

TEUCHOS_UNIT_TEST(strip, motions_that_contradict_are_named) {
  const fields::FieldMesh field = verify::field_of(make_strip());
  const std::string as_one = entry("condition", "string", "moves as one");
  const auto make = [&](const std::string& surfaces) {
    problems::SolidProblem wall(strip(neo_hookean, surfaces), field);
  };
  TEST_THROW(make(sublist("x_high", as_one) + sublist("y_high", as_one)), Error);
  TEST_THROW(make(sublist("x_high", entry("condition", "string", "clamped")) +
                  sublist("end", entry("surface", "string", "x_high") + as_one)),
             Error);
}

}  // namespace
