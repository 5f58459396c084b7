// A tube that was imaged under pressure. Its geometry is the exact one of a tube of known size
// without stress, inflated to a radius of tests/data/inflation.csv; what is found as free of stress
// must be that tube, and further pressure inflate it to the radii of the table.

#include <Teuchos_UnitTestHarness.hpp>

#include "exact_inflation.hpp"
#include "quarter_tube.hpp"
#include "tunica/base/error.hpp"
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
    list.sublist("Wall").sublist("Prestress").set("pressure", pressure).set("tolerance", 1e-6);
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
  double stress_free_radius = 0.0, moved = 0.0;
  int iterations = 0;
  std::map<double, double> radius;  ///< by pressure, of the steps behind
};

Found find(const Imaged& imaged, double step, double last, Teuchos::FancyOStream& out) {
  const Teuchos::ParameterList& list = imaged.list.sublist("Wall");
  problems::SolidProblem wall(list, imaged.mesh);
  Found found;
  const auto prestress = problems::find_prestress(list, wall, [&](const auto& now) {
    ++found.iterations;
    found.moved = now.moved;
  });
  TUNICA_CHECK(prestress.is_success(), prestress.reason());
  found.stress_free_radius = imaged.mean_radius(prestress.value().from_stress_free, -1.0);
  TUNICA_CHECK(wall.set_stress_free(prestress.value().from_stress_free).is_success(), "inverted");
  wall.take(prestress.value().state);
  out << found.iterations << " iterations, radius without stress " << found.stress_free_radius
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

TEUCHOS_UNIT_TEST(prestress, a_tube_finds_its_shape_without_stress_and_answers_as_from_there) {
  struct Case {
    const char *file, *law;
    double imaged_at, step, last;  ///< [kPa]
  };
  for (const Case& each : {Case{"inflation.xml", "mooney-rivlin", 0.3, 0.1, 0.5},
                           Case{"inflation-artery.xml", "two-layer-artery", 0.5, 0.25, 1.0}}) {
    std::vector<double> errors;
    for (const int n : {1, 2}) {
      const Imaged imaged(each.file, each.law, each.imaged_at, n);
      const Found found = find(imaged, each.step, each.last, out);
      TEST_COMPARE(found.moved, <, 1e-6);
      const double error = std::abs(found.stress_free_radius - 1.43);
      TEST_COMPARE(error, <, 5e-3);
      for (const auto& [pressure, radius] : found.radius) {
        const auto exact = imaged.radius.lower_bound(pressure - 1e-9);
        if (exact == imaged.radius.end() || exact->first > pressure + 1e-9) continue;
        const double at_image = imaged.radius.at(imaged.pressure);
        if (std::abs(pressure - imaged.pressure) < 1e-9)  // it stays where it was imaged
          TEST_COMPARE(std::abs(radius - at_image), <, 1e-6);
        const double answer = std::abs(radius - exact->second);
        if (n == 2) TEST_COMPARE(answer, <=, 0.01 * std::abs(exact->second - at_image) + 1e-6);
      }
      errors.push_back(error);
    }
    out << each.law << ": errors " << errors[0] << ", " << errors[1] << "\n";
    TEST_COMPARE(errors[1], <, 0.4 * errors[0]);
  }
}

}  // namespace
