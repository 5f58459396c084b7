#include <Teuchos_UnitTestHarness.hpp>
#include <cmath>

#include "oracle/mooney_rivlin_energy.hpp"
#include "oracle/solid_weak_form.hpp"
#include "tunica/discretisation/solid.hpp"
#include "tunica/kernels/tet4.hpp"
#include "unit/discretisation/few_tets.hpp"

namespace {

using namespace tunica;
using discretisation::Solid;
using test::ElementValues;
using test::FewTets;

constexpr double c10 = 30.0, c01 = 4.0, kappa = 500.0;

Teuchos::ParameterList static_wall() {
  Teuchos::ParameterList list;
  list.sublist("Layers")
      .sublist("block")
      .set<std::string>("law", "mooney-rivlin")
      .set("c10", c10)
      .set("c01", c01)
      .set("bulk modulus", kappa);
  list.set<std::string>("analysis", "static")
      .set<std::string>("stabilisation residual", "linear")
      .set("volumetric stabilisation", 0.7);
  return test::resolved(list, problems::solid_table());
}

/// The weak form of an element of that wall: no inertia, no loads, τ = h²/(4 μ_l).
oracle::SolidWeakForm<oracle::MooneyRivlinEnergy> weak_form(const Solid& wall, std::size_t e) {
  const auto x = assembly::gather(wall.mesh().x, wall.mesh().tets[e]);
  const double h = kernels::element_length(kernels::make_tet4(x).volume);
  const double mu = 2.0 * (c10 + c01);  // μ_l of [LY1]
  return {oracle::Element(x), {c10, c01}, 0.0, 1.0 / kappa, h * h / (4.0 * mu), {}, {}, 0.7 * mu};
}

/// Its sixteen rows, which know their derivatives.
std::array<oracle::First<16>, 16> rows_of(const Solid& wall, std::size_t e,
                                          const ElementValues& values) {
  const auto form = weak_form(wall, e);
  std::array<oracle::Second<16>, 16> y2;
  std::array<oracle::First<16>, 16> y1, R;
  for (int k = 0; k < 16; ++k) {
    oracle::seed(y2[k], k, values[k]);
    oracle::seed(y1[k], k, values[k]);
  }
  const auto Pi = form.potential(y2);
  const auto pspg = form.pspg(y1);
  for (int k = 0; k < 16; ++k) R[k] = Pi.dx(k);
  for (int a = 0; a < 4; ++a) R[12 + a] += pspg[a];
  return R;
}

TEUCHOS_UNIT_TEST(Solid, residual_and_jacobian_are_those_of_the_weak_form) {
  const FewTets few;
  Solid wall(discretisation::solid_options(static_wall()), few.field, {});
  algebra::BlockVector x = test::scattered(few.field, 3, 0.02), F(wall.space()), Kv(wall.space());
  const algebra::BlockVector v = test::scattered(few.field, 5);
  wall.begin_step(stepping::Clock(1.0, 1));
  wall.prescribe(x);
  TEST_ASSERT(wall.residual(x, F).is_success());
  const std::vector<ElementValues> values = test::element_values(few.field, x);
  const auto rows = [&](std::size_t e) { return rows_of(wall, e, values[e]); };
  const algebra::BlockVector expected = test::residual_by_values(few.field, wall.space(), rows);
  TEST_COMPARE(test::relative_difference(F, expected), <, 1e-12);
  wall.assemble_jacobian(x);
  wall.jacobian().apply(v, Kv);
  TEST_COMPARE(test::relative_difference(Kv, test::product_by_derivatives(few.field, v, rows)), <,
               1e-12);
}

TEUCHOS_UNIT_TEST(Solid, what_a_uniform_stretch_stores_is_known) {
  const FewTets few;
  Solid wall(discretisation::solid_options(static_wall()), few.field, {});
  constexpr double stretch = 1.2, p = -3.0;  // along x, and across it what keeps the volume
  const double across = 1.0 / std::sqrt(stretch);
  const algebra::BlockVector x = test::interpolated(
      few.field, wall.space(),
      [&](const Vec3& X) {
        return Vec3{(stretch - 1.0) * X[0], (across - 1.0) * X[1], (across - 1.0) * X[2]};
      },
      [](const Vec3&) { return p; });
  wall.begin_step(stepping::Clock(1.0, 1));
  const discretisation::Observables found = wall.observe(x);
  constexpr double volume = 0.6 * 0.3 * 0.4;
  const double I1 = stretch * stretch + 2.0 / stretch;
  const double I2 = 2.0 * stretch + 1.0 / (stretch * stretch);
  TEST_FLOATING_EQUALITY(test::observed(found, "elastic_energy_kPa_mm3"),
                         volume * 0.5 * (c10 * (I1 - 3.0) + c01 * (I2 - 3.0)), 1e-12);
  TEST_FLOATING_EQUALITY(test::observed(found, "volumetric_energy_kPa_mm3"),
                         volume * 0.5 * p * p / kappa, 1e-12);
  TEST_FLOATING_EQUALITY(test::observed(found, "min_det_F"), 1.0, 1e-12);
  TEST_FLOATING_EQUALITY(test::observed(found, "max_det_F"), 1.0, 1e-12);
  const Vec3 corner{0.6 * (stretch - 1.0), 0.3 * (across - 1.0), 0.4 * (across - 1.0)};
  TEST_FLOATING_EQUALITY(test::observed(found, "max_displacement_wall_mm"), norm(corner), 1e-12);
}

}  // namespace
