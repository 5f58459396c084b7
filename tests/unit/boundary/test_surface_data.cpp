#include <Teuchos_UnitTestHarness.hpp>
#include <cstdio>
#include <fstream>

#include "tunica/base/error.hpp"
#include "tunica/boundary/registry.hpp"
#include "tunica/boundary/surface_terms.hpp"
#include "unit/fields/small_tube.hpp"

namespace {

using namespace tunica;
using test::SmallTube;

/// A file that rank 0 writes and that is gone when it goes out of scope.
class DataFile {
public:
  DataFile(const Comm& comm, const std::string& text) : comm_(&comm) {
    if (comm.getRank() == 0) std::ofstream(name, std::ios::binary) << text;
    comm.barrier();
  }
  ~DataFile() {
    comm_->barrier();
    if (comm_->getRank() == 0) std::remove(name);
  }
  static constexpr const char* name = "surface-data.csv";

private:
  const Comm* comm_;
};

Vec3 linear(const Vec3& x) { return {1.0 + 2.0 * x[0] - x[1], 0.3 * x[1], -x[0]}; }

/// Of a rotated grid of points around the inlet of the tube, at z = 0; factors of linear() in time.
std::string grid(const std::vector<double>& times, double period) {
  std::ostringstream text;
  text.precision(17);
  text << (period > 0.0 ? "time,x,y,z,u,v,w\n" : "# no times\n");
  for (const double t : times)
    for (int i = -5; i <= 5; ++i)
      for (int j = -5; j <= 5; ++j) {
        const Vec3 x{0.31 * i - 0.11 * j, 0.12 * i + 0.33 * j, 0.0};
        const double a = period > 0.0 ? std::sin(2.0 * M_PI * t / period) : 1.0;
        const Vec3 u = a * linear(x);
        if (period > 0.0) text << t << ",";
        text << x[0] << "," << x[1] << "," << x[2] << "," << u[0] << "," << u[1] << "," << u[2]
             << "\n";
      }
  return text.str();
}

boundary::Condition from_file(const std::string& kind, double period) {
  Teuchos::ParameterList list;
  list.set("condition", kind).set("file", DataFile::name).set("period", period);
  const bool is_fluid = kind == "velocity from file";
  boundary::condition_table("",
                            is_fluid ? boundary::fluid_conditions() : boundary::wall_conditions())
      .resolve(list, "inlet", ".");
  return {"inlet", list};
}

std::vector<Vec3> velocities(const SmallTube& tube, double period, double time) {
  const fields::FieldMesh& mesh = tube.fluid;
  const std::vector<Vec3> zero(mesh.n_nodes());
  boundary::SurfaceTerms terms({from_file("velocity from file", period)},
                               boundary::fluid_conditions(), mesh);
  Vector u(mesh.vector_map);
  terms.impose({&mesh, &mesh.x, &mesh.x, &zero, &zero, 1.06, time}, u);
  return fields::owned_vectors(mesh, u);
}

TEUCHOS_UNIT_TEST(surface_data, is_exact_where_it_is_linear_in_space) {
  const SmallTube tube;
  const DataFile file(*tube.fluid.comm, grid({0.0}, 0.0));
  const auto u = velocities(tube, 0.0, 3.0);
  for (int a = 0; a < tube.fluid.n_owned; ++a)
    if (tube.fluid.is_on(a, tube.surface("inlet")))
      TEST_COMPARE(norm(u[a] - linear(tube.fluid.x[a])), <, 1e-10);
}

TEUCHOS_UNIT_TEST(surface_data, is_a_periodic_spline_in_time) {
  const SmallTube tube;
  std::vector<double> times;
  for (int k = 0; k < 32; ++k) times.push_back(25.0 * k);
  for (const bool is_closed : {false, true}) {
    if (is_closed) times.push_back(800.0005);  // but for its digits
    const DataFile file(*tube.fluid.comm, grid(times, 800.0));
    for (const double time : {0.0, 110.0, 2313.0}) {
      const auto u = velocities(tube, 800.0, time);
      const double a_t = std::sin(2.0 * M_PI * time / 800.0);
      for (int a = 0; a < tube.fluid.n_owned; ++a)
        if (tube.fluid.is_on(a, tube.surface("inlet")))
          TEST_COMPARE(norm(u[a] - a_t * linear(tube.fluid.x[a])), <, 5e-5);
    }
  }
}

TEUCHOS_UNIT_TEST(surface_data, files_may_begin_with_a_byte_order_mark_and_a_heading) {
  const SmallTube tube;
  const std::string text = grid({0.0}, 0.0);
  const DataFile file(*tube.fluid.comm,
                      "\xef\xbb\xbfx,y,z,u,v,w\r" + text.substr(text.find('\n') + 1));
  const auto u = velocities(tube, 0.0, 3.0);
  for (int a = 0; a < tube.fluid.n_owned; ++a)
    if (tube.fluid.is_on(a, tube.surface("inlet")))
      TEST_COMPARE(norm(u[a] - linear(tube.fluid.x[a])), <, 1e-10);
}

TEUCHOS_UNIT_TEST(surface_data, moves_the_wall_in_the_components_that_are_named) {
  const SmallTube tube;
  const fields::FieldMesh& mesh = tube.wall;
  const DataFile file(*mesh.comm, grid({0.0}, 0.0));
  boundary::Condition condition = from_file("displacement from file", 0.0);
  condition.list.set("components", Teuchos::Array<std::string>(Teuchos::tuple<std::string>("y")));
  const std::string ring = "struct_in";
  condition.surface = ring;
  boundary::SurfaceTerms terms({condition}, boundary::wall_conditions(), mesh);
  const std::vector<Vec3> zero(mesh.n_nodes());
  Vector d(mesh.vector_map);
  d.putScalar(7.0);
  terms.impose({&mesh, &mesh.x, &mesh.x, &zero, &zero, 0.0, 1.0}, d);
  const auto values = fields::owned_vectors(mesh, d);
  const int surface = tube.surface(ring);
  for (int a = 0; a < mesh.n_owned; ++a)
    if (mesh.is_on(a, surface))
      TEST_COMPARE(norm(values[a] - Vec3{7.0, linear(mesh.x[a])[1], 7.0}), <, 1e-9);
}

/// What the condition complains about.
std::string complaint(const std::string& text, double period = 0.0) {
  const SmallTube tube;
  const DataFile file(*tube.fluid.comm, text);
  try {
    velocities(tube, period, 0.0);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEUCHOS_UNIT_TEST(surface_data, says_what_is_wrong_and_where) {
  const auto has = [](const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
  };
  TEST_ASSERT(has(complaint("x,y,z,u,v,w\n0,0,0,1,2\n"), ".csv:2: expected 6 or 7 numbers"));
  TEST_ASSERT(has(complaint("0,0,0,1,2,nan\n"), ".csv:1: expected"));
  TEST_ASSERT(has(complaint("0,0,0,1,2,3.0x\n"), ".csv:1: expected"));
  TEST_ASSERT(has(complaint("0,0,0,1,2,3\n0,0,0,0,1,2,3\n"), ".csv:2: expected 6 numbers"));
  TEST_ASSERT(has(complaint("# nothing\n"), "no point"));
  TEST_ASSERT(has(complaint("0,0,0,0,1,2,3\n1,0,0,1,1,2,3\n"), ".csv:2: each time must have"));
  TEST_ASSERT(has(complaint("0,0,0,0,1,2,3\n0,0,1,0,1,2,3\n1,0,0,0,1,2,3\n"), "fewer points"));
  TEST_ASSERT(has(complaint("1,0,0,0,1,2,3\n0,0,0,0,1,2,3\n"), "times must increase"));
  TEST_ASSERT(has(complaint("100,0,0,1,2,3\n"), "points lie up to"));
  TEST_ASSERT(has(complaint(grid({0.0, 1.0, 9.0}, 5.0), 5.0), "more than the period"));
}

}  // namespace
