// Forces of a fluid on its surfaces, by nodal reactions where the velocity is prescribed.
//
// A flow u = γ a (b·x), a ⊥ b, under a body force f has σ = μγ (a bᵀ + b aᵀ) − p I with
// p = ρ f·(x − c): linear elements have it exactly. Each triangle of area vector A takes −σ A from
// the fluid, also where each is a surface of its own and they meet in every node.
//
// In any flow the forces on all surfaces and the change of momentum add up to nothing:
//
//   Σ_s F_s = −∫ ρ ((u − u_old)/Δt + (u·∇)u) dV

#include <Teuchos_UnitTestHarness.hpp>

#include "fluid_on_cube.hpp"
#include "tunica/assembly/gather.hpp"
#include "tunica/kernels/surface_tri3.hpp"
#include "tunica/mesh/validate.hpp"

namespace {

using namespace tunica;
using verify::entry;
using verify::sublist;

double observed(const discretisation::Observables& all, const std::string& name) {
  for (const discretisation::Observable& o : all)
    if (o.name == name) return o.value;
  return std::nan("");
}

/// "pressure_force" or "viscous_force" on a surface.
Vec3 part(const discretisation::Observables& all, const std::string& name,
          const std::string& surface) {
  const std::string start = name + "_" + surface + "_";
  return {observed(all, start + "x_mN"), observed(all, start + "y_mN"),
          observed(all, start + "z_mN")};
}

/// The cube; its sides, or all triangles of them, are surfaces.
mesh::Mesh cut_cube(int n, bool by_triangles) {
  mesh::Mesh mesh = verify::make_cube(n);
  mesh.surfaces.clear();
  const int count = by_triangles ? static_cast<int>(mesh.triangles.size()) : 6;
  for (int s = 0; s < count; ++s) mesh.surfaces.push_back({s + 1, "part-" + std::to_string(s)});
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    int side = 0;
    for (int i = 0; i < 3; ++i)
      for (const double end : {0.0, 1.0}) {
        const auto is_on = [&](int v) { return mesh.vertices[v][i] == end; };
        if (std::all_of(mesh.triangles[t].begin(), mesh.triangles[t].end(), is_on))
          side = 2 * i + static_cast<int>(end);
      }
    mesh.triangle_surface[t] = by_triangles ? static_cast<int>(t) : side;
  }
  mesh::validate(mesh, "cut cube");
  return mesh;
}

constexpr double density = 1.06, viscosity = 0.03, shear = 0.7;
const Vec3 a{1.0 / 3.0, 2.0 / 3.0, 2.0 / 3.0}, b{2.0 / 3.0, 1.0 / 3.0, -2.0 / 3.0};
const Vec3 body_force{0.3, -0.2, 0.5}, centre{0.5, 0.5, 0.5};

Vec3 flow(const Vec3& x) { return shear * dot(b, x) * a; }
double pressure(const Vec3& x) { return density * dot(body_force, x - centre); }

Teuchos::ParameterList given_all_around(const fields::FieldMesh& field) {
  std::string conditions;
  for (const std::string& name : field.surfaces)
    conditions += sublist(name, entry("condition", "string", "velocity") +
                                    entry("velocity", "Array(double)", "{0, 0, 0}"));
  return verify::resolved(problems::fluid_table(),
                          entry("density", "double", "1.06") +
                              entry("viscosity", "double", "0.03") +
                              sublist("Surfaces", conditions) +
                              sublist("Newton", entry("relative increment", "double", "1e-12")) +
                              sublist("Linear Solver", entry("method", "string", "direct")));
}

TEUCHOS_UNIT_TEST(surface_forces, linear_flows_have_their_exact_forces_wherever_surfaces_meet) {
  for (const bool by_triangles : {false, true}) {
    const fields::FieldMesh field = verify::field_of(cut_cube(3, by_triangles));
    const int count = static_cast<int>(field.surfaces.size());
    TEST_EQUALITY(count, by_triangles ? 6 * 2 * 9 : 6);
    problems::FluidProblem fluid(given_all_around(field), field);
    fluid.set_initial_velocity(flow);
    fluid.set_boundary_velocity([](const Vec3& x, double) { return flow(x); });
    fluid.set_body_force([](const Vec3&, double) { return body_force; });
    fluid.begin_step(stepping::Clock(0.5, 1));
    TEST_ASSERT(fluid.solve().is_converged);
    std::vector<double> exact(8 * count, 0.0);  // pressure force, viscous force, area, ∫ p dA
    for (const fields::Face& face : field.faces) {
      if (!face.is_owned) continue;
      const auto x = assembly::gather(field.x, face.nodes);
      const Vec3 A = kernels::area_normal(x);
      const double p = pressure(1.0 / 3.0 * (x[0] + x[1] + x[2]));
      const Vec3 viscous = -viscosity * shear * (dot(b, A) * a + dot(a, A) * b);
      double* of_surface = exact.data() + 8 * face.surface;
      for (int i = 0; i < 3; ++i) of_surface[i] += p * A[i];
      for (int i = 0; i < 3; ++i) of_surface[3 + i] += viscous[i];
      of_surface[6] += norm(A);
      of_surface[7] += p * norm(A);
    }
    exact = global_sum(*field.comm, exact);
    const auto found = fluid.observe_surfaces(fields::bounding_surfaces(field));
    double worst = 0.0;
    for (int s = 0; s < count; ++s) {
      const double* e = exact.data() + 8 * s;
      const std::string& name = field.surfaces[s];
      worst = std::max({worst, norm(part(found, "pressure_force", name) - Vec3{e[0], e[1], e[2]}),
                        norm(part(found, "viscous_force", name) - Vec3{e[3], e[4], e[5]}),
                        std::abs(observed(found, "area_" + name + "_mm2") - e[6]),
                        std::abs(observed(found, "mean_pressure_" + name + "_kPa") - e[7] / e[6])});
      TEST_COMPARE(norm(Vec3{e[3], e[4], e[5]}), >, 1e-5);
    }
    out << count << " surfaces: largest error " << worst << "\n";
    TEST_COMPARE(worst, <, 1e-12);
  }
}

TEUCHOS_UNIT_TEST(surface_forces, forces_and_change_of_momentum_balance) {
  const double R = 1.43;
  const fields::FieldMesh field = verify::lumen(R, 6.0 * R, 1);
  const auto end = [](const std::string& p) {
    return entry("condition", "string", "pressure") + entry("pressure", "double", p) +
           entry("backflow stabilisation", "double", "0.2");
  };
  problems::FluidProblem fluid(
      verify::resolved(
          problems::fluid_table(),
          entry("density", "double", "1") + entry("viscosity", "double", "0.1") +
              entry("time scheme", "string", "implicit euler") +
              sublist("Surfaces",
                      sublist("inlet", end("0.04")) + sublist("outlet", end("0")) +
                          sublist("interface", entry("condition", "string", "no slip"))) +
              sublist("Newton", entry("relative increment", "double", "1e-13")) +
              sublist("Linear Solver", entry("method", "string", "direct"))),
      field);
  const double area = 4.0 * R * R * std::sin(std::acos(-1.0) / 4.0);
  for (const double dt : {0.5, 1e4}) {  // in the middle of the start, and at the end of it
    stepping::Clock clock(dt, 4);
    Vec3 left{}, total{};
    double drag = 0.0;
    for (; !clock.is_done(); clock.advance()) {
      const auto u_old = fields::ghosted_vectors(field, fluid.state()[0]);
      fluid.begin_step(clock);
      TEST_ASSERT(fluid.solve().is_converged);
      const auto u = fields::ghosted_vectors(field, fluid.state()[0]);
      fluid.end_step();
      const auto found = fluid.observe_surfaces(fields::bounding_surfaces(field));
      Vec3 change{};
      for (std::size_t e = 0; e < field.tets.size(); ++e) {
        if (!field.is_owned[e]) continue;
        const kernels::Tet4& T = fluid.elements().geometry[e];
        Vec3 mean{}, rate{}, convection{};
        for (const int node : field.tets[e]) {
          mean += 0.25 * u[node];
          rate += 0.25 / dt * (u[node] - u_old[node]);
        }
        for (int k = 0; k < 4; ++k) convection += dot(T.grad_N[k], mean) * u[field.tets[e][k]];
        change += T.volume * (rate + convection);
      }
      for (int i = 0; i < 3; ++i) left[i] = global_sum(*field.comm, change[i]);
      total = {};
      for (const char* name : {"inlet", "outlet", "interface"})
        total += part(found, "pressure_force", name) + part(found, "viscous_force", name);
      drag = part(found, "viscous_force", "interface")[2];
      TEST_COMPARE(norm(total + left), <, 1e-10 * 0.04 * area);
    }
    out << "dt " << dt << ": drag " << drag / (0.04 * area)
        << " of pressure drop times area, change of momentum " << left[2] / (0.04 * area) << "\n";
    if (dt > 1.0) TEST_FLOATING_EQUALITY(drag, 0.04 * area, 2e-2);
  }
}

}  // namespace
