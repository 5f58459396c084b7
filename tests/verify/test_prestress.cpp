// A tube that was imaged under pressure. Its geometry is the exact one of a tube of known size
// without stress, inflated to a radius of tests/data/inflation.csv. With the prestress that is
// found it must stay there, and further pressure inflate it to the radii of the table; the shape
// without stress must be that tube.

#include <Teuchos_Array.hpp>
#include <Teuchos_UnitTestHarness.hpp>

#include "exact_inflation.hpp"
#include "quarter_tube.hpp"
#include "tunica/base/error.hpp"
#include "tunica/mesh/block.hpp"
#include "tunica/problems/prestress.hpp"

namespace {

using namespace tunica;

struct Imaged {
  Teuchos::ParameterList list;  ///< of the case
  std::map<double, double> radius;
  double pressure;  ///< at which it was imaged [kPa]
  fields::FieldMesh mesh;

  Imaged(const std::string& file, const std::string& law, double imaged_at, int n)
      : list(verify::case_of(file)), radius(verify::exact_radius(law)), pressure(imaged_at),
        mesh(verify::field_of(inflated(n, radius.at(pressure)))) {
    prestress().set("pressure", pressure).set("tolerance", 1e-7);
  }
  Teuchos::ParameterList& prestress() { return list.sublist("Wall").sublist("Prestress"); }

  /// A tube that was pressed flat: an ellipse in place of the circle.
  void flatten(double wide, double high) {
    mesh::Mesh quarter = verify::make_quarter_tube(2);
    for (Vec3& x : quarter.vertices) x = {wide * x[0], high * x[1], x[2]};
    mesh = verify::field_of(quarter);
  }
  /// The quarter of a tube whose points have moved from R to r = (R² − R_i² + r_i²)^½.
  static mesh::Mesh inflated(int n, double inner_radius) {
    mesh::Mesh quarter = verify::make_quarter_tube(n);
    for (Vec3& x : quarter.vertices) {
      const double R = std::hypot(x[0], x[1]);
      const double r = std::sqrt(R * R - 1.43 * 1.43 + inner_radius * inner_radius);
      x = {r / R * x[0], r / R * x[1], x[2]};
    }
    return quarter;
  }
  double mean_radius(const std::vector<Vec3>& moved, double sign) const {
    const int inner = mesh.surface_index("interface");
    return verify::mean_over_nodes(mesh, [&](int a) {
      const Vec3 x = mesh.x[a] + sign * moved[a];
      return mesh.is_on(a, inner) ? std::hypot(x[0], x[1]) : std::nan("");
    });
  }
};

struct Found {
  double least_det = 0.0, most_det = 0.0, moved = 0.0;
  int iterations = 0;
  std::map<double, double> radius;  ///< by pressure, of the steps behind
};

Found find(const Imaged& imaged, double step, double last, Teuchos::FancyOStream& out) {
  const Teuchos::ParameterList& list = imaged.list.sublist("Wall");
  problems::SolidProblem wall(list, imaged.mesh);
  Found found;
  problems::PrestressWatch watch;
  watch.report = [&](const problems::PrestressIteration& now) {
    ++found.iterations;
    found.moved = now.moved;
    found.least_det = now.least;
    found.most_det = now.most;
    out << "load " << now.load << ": " << now.residual << " left, " << now.moved << " mm\n";
  };
  const auto prestress = problems::find_prestress(list, wall, watch);
  TUNICA_CHECK(prestress.is_success(), prestress.reason());
  TUNICA_CHECK(wall.field().set_prestretch(prestress.value().prestretch).is_success(), "inverted");
  wall.take(prestress.value().state);
  out << found.iterations << " iterations, det G " << found.least_det << " to " << found.most_det
      << "; pressure, radius:";
  for (stepping::Clock clock(1.0, static_cast<int>(std::lround(last / step))); !clock.is_done();
       clock.advance()) {
    wall.begin_step(clock);
    const nonlinear::NewtonReport report = wall.solve();
    TUNICA_CHECK(report.is_converged, report.reason);
    wall.end_step();
    const double pressure = step * clock.step();
    found.radius[pressure] = imaged.mean_radius(wall.displacement(), 1.0);
    out << "  " << pressure << ", " << found.radius[pressure];
  }
  out << "\n";
  return found;
}

// In steps of the case, from no pressure: the first brings it back to where it has less, or none.

struct Case {
  const char *file, *law;
  double imaged_at, step, last;  ///< [kPa]
};
const Case mooney_rivlin{"inflation.xml", "mooney-rivlin", 0.3, 0.1, 0.5};
const Case artery{"inflation-artery.xml", "two-layer-artery", 0.5, 0.25, 1.0};

TEUCHOS_UNIT_TEST(prestress, a_tube_stays_where_it_was_imaged_and_answers_as_from_without_stress) {
  for (const Case& each : {mooney_rivlin, artery})
    for (const std::string method : {"deformation gradient", "stress-free shape"}) {
      Imaged imaged(each.file, each.law, each.imaged_at, 2);
      imaged.prestress().set("method", method);
      const Found found = find(imaged, each.step, each.last, out);
      TEST_COMPARE(found.moved, <, 1e-6);
      const double at_image = imaged.radius.at(imaged.pressure);
      for (const auto& [pressure, radius] : found.radius) {
        const auto exact = imaged.radius.lower_bound(pressure - 1e-9);
        if (exact == imaged.radius.end() || exact->first > pressure + 1e-9) continue;
        if (std::abs(pressure - imaged.pressure) < 1e-9)  // it stays where it was imaged
          TEST_COMPARE(std::abs(radius - at_image), <, 1e-6);
        const double answer = std::abs(radius - exact->second);
        out << each.law << " " << method << " " << pressure << ": "
            << answer / std::abs(exact->second - at_image) << "\n";
        TEST_COMPARE(answer, <=, 0.01 * std::abs(exact->second - at_image) + 1e-6);
      }
    }
}

// The flat sides of an oval tube bear the pressure by bending, in which a wall that moved would
// buckle or become round. It is sought where it lies, and there is nothing to buckle.

TEUCHOS_UNIT_TEST(prestress, of_a_flat_thin_wall_is_found_in_a_few_steps) {
  Imaged imaged(mooney_rivlin.file, mooney_rivlin.law, mooney_rivlin.imaged_at, 2);
  imaged.flatten(1.3, 0.5);
  imaged.prestress().set("pressure", 0.2);
  const Found found = find(imaged, 1.0, 0.0, out);  // the search alone
  TEST_COMPARE(found.moved, <, 1e-6);
  TEST_COMPARE(found.iterations, <=, 20);
  TEST_COMPARE(found.least_det, >, 0.3);
  TEST_COMPARE(found.most_det, <, 3.0);
}

// A plate between planes along which it slides can bear no pressure p: springs of stiffness k hold
// it, stretched by p/k. What is stopped while they are released goes on from there.

constexpr double on_plate = 2.0, stiffness = 5.0;

struct Held {
  int in_releases = 0;  ///< steps
  problems::TissueHold tissue{};
  problems::PrestressPoint point{};  ///< where it was stopped
  problems::Prestress state;
};

Teuchos::ParameterList plate_list() {
  Teuchos::ParameterList list = verify::case_of("block.xml").sublist("Wall");
  Teuchos::ParameterList surfaces;
  const auto hold = [&](const std::string& side, const std::string& condition) -> auto& {
    return surfaces.sublist(side).set("condition", condition);
  };
  for (const char* side : {"x_low", "x_high", "y_low", "y_high"})
    hold(side, "held").set("components", Teuchos::Array<std::string>(1, "normal"));
  hold("z_high", "support").set("stiffness", stiffness);
  list.set("Surfaces", surfaces);
  list.sublist("Layers").sublist("block").set("c10", 20.0).set("bulk modulus", 1e4);
  list.sublist("Prestress")
      .set("pressure", on_plate)
      .set("surfaces", Teuchos::Array<std::string>(1, "z_low"))
      .set("tolerance", 1e-6)
      .set("linear tolerance", 1e-12);
  problems::solid_table().resolve(list, "Wall", "");
  return list;
}

/// stop_at: the step after the first release at which it is stopped; 0: never.
Held search_plate(const Teuchos::ParameterList& list, const fields::FieldMesh& mesh, int stop_at,
                  const Held* from, Teuchos::FancyOStream& out) {
  problems::SolidProblem wall(list, mesh);
  Held held{0, {}, {}, {{}, algebra::BlockVector(wall.space())}};
  if (from != nullptr) {
    TUNICA_CHECK(wall.field().set_prestretch(from->state.prestretch).is_success(), "inverted");
    wall.field().set_spring_offset(from->state.offset);
    wall.take(from->state.state);
  }
  problems::PrestressWatch watch;
  watch.report = [&](const problems::PrestressIteration& now) {
    held.tissue = now.tissue;
    out << now.load << " " << now.moved << " " << now.tissue.mean << " " << now.reason << "\n";
  };
  watch.goes_on = [&](const problems::PrestressPoint& point, const problems::Prestress& state) {
    held.in_releases += point.releases > 0;
    if (stop_at == 0 || held.in_releases < stop_at) return true;
    held.point = point;
    held.state.prestretch = state.prestretch;
    held.state.offset = state.offset;
    held.state.state.assign(state.state);
    return false;
  };
  const auto found = problems::find_prestress(
      list, wall, watch, from != nullptr ? from->point : problems::PrestressPoint{});
  TUNICA_CHECK(found.is_success() == (stop_at == 0), found.reason());
  return held;
}

TEUCHOS_UNIT_TEST(prestress, that_is_stopped_in_a_release_goes_on_where_it_began) {
  const Teuchos::ParameterList list = plate_list();
  const fields::FieldMesh mesh =
      verify::field_of(mesh::make_block({{4.0, 4.0, 0.5}, {4, 4, 2}, {0, 0}}));
  const Held whole = search_plate(list, mesh, 0, nullptr, out);
  TEST_COMPARE(whole.in_releases, >=, 1);
  TEST_FLOATING_EQUALITY(whole.tissue.mean, on_plate, 1e-6);
  TEST_FLOATING_EQUALITY(whole.tissue.most, on_plate, 1e-6);
  const Held begun = search_plate(list, mesh, 1, nullptr, out);
  TEST_EQUALITY(begun.point.releases, 1);
  for (const Vec3& offset : begun.state.offset)
    TEST_FLOATING_EQUALITY(offset[2], on_plate / stiffness, 1e-3);  // not what is left of it
  const Held gone_on = search_plate(list, mesh, 0, &begun, out);
  TEST_EQUALITY(gone_on.in_releases, whole.in_releases);
  TEST_FLOATING_EQUALITY(gone_on.tissue.mean, on_plate, 1e-6);
}

}  // namespace
