// A long tube under static inner pressure, plane strain, against quadrature of the radial
// equilibrium (tests/data/inflation.csv). Symmetry planes hold a quarter of it without forces
// that the whole tube would not have. The case is xml/inflation.xml.

#include <Teuchos_UnitTestHarness.hpp>
#include <fstream>
#include <map>
#include <sstream>

#include "app/case.hpp"
#include "app/schema.hpp"
#include "base/error.hpp"
#include "field_of.hpp"
#include "mesh/read.hpp"
#include "problems/solid_problem.hpp"
#include "quarter_tube.hpp"

namespace {

using namespace tunica;

Teuchos::ParameterList inflation_case() {
  app::CommandLine command;
  command.case_file = TUNICA_CASES "/inflation.xml";
  return app::read_case(command, app::solid_table(), *Tpetra::getDefaultComm());
}

/// Inner radius by pressure.
std::map<double, double> exact_radius() {
  std::ifstream file(TUNICA_TEST_DATA "/inflation.csv");
  std::map<double, double> radius;
  for (std::string line; std::getline(file, line);) {
    std::istringstream cells(line);
    std::string law, pressure, value;
    std::getline(cells, law, ',');
    std::getline(cells, pressure, ',');
    std::getline(cells, value, ',');
    if (law == "mooney-rivlin") radius[std::stod(pressure)] = std::stod(value);
  }
  return radius;
}

double inner_radius(const problems::SolidProblem& wall) {
  const fields::FieldMesh& mesh = wall.mesh();
  const auto inner = std::find(mesh.surfaces.begin(), mesh.surfaces.end(), "interface");
  const int surface = static_cast<int>(inner - mesh.surfaces.begin());
  const std::vector<Vec3> d = wall.displacement();
  return verify::mean_over_nodes(mesh, [&](int a) {
    const Vec3 x = mesh.x[a] + d[a];
    return mesh.is_on(a, surface) ? std::hypot(x[0], x[1]) : std::nan("");
  });
}

/// Relative error of the inner radius at 0.1, 0.3, 0.5 kPa.
std::vector<double> errors_on(const mesh::Mesh& mesh, const Teuchos::ParameterList& list) {
  const fields::FieldMesh field = verify::field_of(mesh);
  problems::SolidProblem wall(list.sublist("Wall"), field);
  const std::map<double, double> exact = exact_radius();
  std::vector<double> errors;
  for (stepping::Clock clock(list.sublist("Time")); !clock.is_done(); clock.advance()) {
    wall.begin_step(clock);
    const nonlinear::NewtonReport report = wall.solve();
    TUNICA_CHECK(report.is_converged, report.reason);
    wall.end_step();
    if (clock.step() % 2 == 0) continue;
    const double radius = exact.at(std::round(clock.step()) / 10.0);
    errors.push_back(inner_radius(wall) / radius - 1.0);
  }
  return errors;
}

TEUCHOS_UNIT_TEST(inflation, inflated_tube_converges_to_the_exact_radius_at_second_order) {
  const Teuchos::ParameterList list = inflation_case();
  std::vector<std::vector<double>> errors;
  for (const int n : {1, 2, 4}) errors.push_back(errors_on(verify::make_quarter_tube(n), list));
  for (int load = 0; load < 3; ++load) {
    out << "load " << load << ": errors " << errors[0][load] << " " << errors[1][load] << " "
        << errors[2][load] << "\n";
    for (int level = 1; level < 3; ++level)
      TEST_COMPARE(verify::order(std::abs(errors[level - 1][load]), std::abs(errors[level][load])),
                   >=, 1.8);
    TEST_COMPARE(std::abs(errors[2][load]), <, 5e-3);
  }
}

TEUCHOS_UNIT_TEST(inflation, nearly_incompressible_wall_does_not_lock) {
  // An element that locks becomes stiff with κ on a coarse mesh and softens with refinement:
  // the radius would change far more between two meshes at 1e5 kPa than at 1e3 kPa.
  Teuchos::ParameterList list = inflation_case();
  std::vector<std::vector<double>> change;
  for (const double kappa : {1e3, 1e5}) {
    for (const std::string layer : {"media", "adventitia"})
      list.sublist("Wall").sublist("Layers").sublist(layer).set("bulk modulus", kappa);
    change.push_back(errors_on(verify::make_quarter_tube(2), list));
    const std::vector<double> coarse = errors_on(verify::make_quarter_tube(1), list);
    for (int load = 0; load < 3; ++load) change.back()[load] -= coarse[load];
  }
  for (int load = 0; load < 3; ++load) {
    out << "load " << load << ": change " << change[0][load] << " " << change[1][load] << "\n";
    TEST_COMPARE(change[1][load], <, 1.2 * change[0][load]);
  }
}

TEUCHOS_UNIT_TEST(inflation, shipped_mesh_is_the_second_of_the_study) {
  const mesh::Mesh shipped = mesh::read(TUNICA_MESHES "/quarter-tube.h5");
  const mesh::Mesh made = verify::make_quarter_tube(2);
  TEST_ASSERT(shipped.tets == made.tets);
  TEST_EQUALITY(shipped.vertices.size(), made.vertices.size());
  double distance = 0.0;
  for (std::size_t v = 0; v < std::min(shipped.vertices.size(), made.vertices.size()); ++v)
    distance = std::max(distance, norm(shipped.vertices[v] - made.vertices[v]));
  TEST_COMPARE(distance, <, 1e-12);
}

}  // namespace
