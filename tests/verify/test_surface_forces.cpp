// Forces of a fluid on its surfaces, by nodal reactions where the velocity is prescribed.
//
// A flow u = γ a (b·x), a ⊥ b, under a body force f has σ = μγ (a bᵀ + b aᵀ) − p I with
// p = ρ f·(x − c): linear elements have it exactly. Each triangle of area vector A takes −σ A from
// the fluid, also where each is a surface of its own and they meet in every node.
//
// A plane that is held along its normal takes no force along itself, whatever meets it there. A
// block between such planes that is pressed to the length λ in uniaxial stress,
// St.Venant–Kirchhoff: F = A E λ (λ² − 1)/2, exact with linear elements.
//
// In any flow the forces on all surfaces and the change of momentum add up to nothing:
//
//   Σ_s F_s = −∫ ρ ((u − u_old)/Δt + (u·∇)u) dV − Σ_a ω_a ∫ N_a ρ (u' − u'_old)/Δt dV
//
// with the subscales u' and ω_a = 1 at vertices on walls where subscales are tracked, 0 elsewhere.

#include <Teuchos_UnitTestHarness.hpp>

#include "fluid_on_cube.hpp"
#include "tunica/assembly/gather.hpp"
#include "tunica/kernels/surface_tri3.hpp"
#include "tunica/mesh/block.hpp"
#include "tunica/mesh/validate.hpp"
#include "tunica/problems/solid_problem.hpp"

namespace {

using namespace tunica;
using verify::entry;
using verify::sublist;

double observed(const discretisation::Observables& all, const std::string& name) {
  for (const discretisation::Observable& o : all)
    if (o.name == name) return o.value;
  return std::nan("");
}

/// "pressure_force", "viscous_force" or "wall_force" on a surface.
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

std::string held(const std::string& component) {
  return entry("condition", "string", "held") +
         entry("components", "Array(string)", "{" + component + "}");
}

/// But for a plane of symmetry, if there is one.
Teuchos::ParameterList given_all_around(const fields::FieldMesh& field,
                                        const std::string& plane = "") {
  std::string conditions;
  for (const std::string& name : field.surfaces)
    conditions +=
        sublist(name, name == plane ? held("normal")
                                    : entry("condition", "string", "velocity") +
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
    fluid.field().set_boundary_velocity([](const Vec3& x, double) { return flow(x); });
    fluid.field().set_body_force([](const Vec3&, double) { return body_force; });
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

TEUCHOS_UNIT_TEST(surface_forces, planes_of_symmetry_take_no_force_along_themselves) {
  const std::string plane = "part-2";  // y = 0, turned by 20° about z
  const double c = std::cos(std::acos(-1.0) / 9.0), s = std::sin(std::acos(-1.0) / 9.0);
  mesh::Mesh turned = cut_cube(3, false);
  for (Vec3& x : turned.vertices) x = {c * x[0] - s * x[1], s * x[0] + c * x[1], x[2]};
  const fields::FieldMesh field = verify::field_of(turned);
  problems::FluidProblem fluid(given_all_around(field, plane), field);
  fluid.field().set_boundary_velocity([c, s](const Vec3& X, double) {
    const double x = c * X[0] + s * X[1], y = -s * X[0] + c * X[1];
    return Vec3{0.0, 0.0, (1.0 - x * x) * (2.0 - y * y)};
  });
  fluid.begin_step(stepping::Clock(0.5, 1));
  TEST_ASSERT(fluid.solve().is_converged);
  const auto found = fluid.observe_surfaces(fields::bounding_surfaces(field));
  const Vec3 n{-s, c, 0.0}, F = part(found, "viscous_force", plane);
  const double friction = norm(F - dot(F, n) * n);
  const double of_side = std::abs(part(found, "viscous_force", "part-1")[2]);
  out << "friction " << friction << ", of a side " << of_side << "\n";
  TEST_COMPARE(friction, <, 1e-14);
  TEST_COMPARE(of_side, >, 1e-2);
}

Teuchos::ParameterList pressed_between_planes() {
  return verify::resolved(
      problems::solid_table(),
      entry("analysis", "string", "static") +
          sublist("Layers", sublist("block", entry("law", "string", "st-venant-kirchhoff") +
                                                 entry("young modulus", "double", "100") +
                                                 entry("poisson ratio", "double", "0.3"))) +
          sublist(
              "Surfaces",
              sublist("x_low", held("normal")) + sublist("y_low", held("normal")) +
                  sublist("z_low", held("z")) +
                  sublist("z_high", entry("condition", "string", "moved") +
                                        entry("components", "Array(string)", "{z}") +
                                        entry("displacement", "Array(double)", "{0, 0, -0.1}"))) +
          sublist("Newton", entry("relative increment", "double", "1e-12")) +
          sublist("Linear Solver", entry("method", "string", "direct")));
}

TEUCHOS_UNIT_TEST(surface_forces, what_presses_a_block_has_all_of_the_force_beside_held_planes) {
  const fields::FieldMesh field =
      verify::field_of(mesh::make_block({{1.0, 1.0, 1.0}, {2, 2, 2}, {0, 0}}));
  problems::SolidProblem wall(pressed_between_planes(), field);
  wall.begin_step(stepping::Clock(1.0, 1));
  TEST_ASSERT(wall.solve().is_converged);
  wall.end_step();
  const auto found = wall.observe_surfaces(fields::bounding_surfaces(wall.mesh()));
  const double exact = 100.0 * 0.9 * 0.095;
  const auto force = [&found](const char* on) { return part(found, "wall_force", on); };
  out << "force " << force("z_high")[2] << " and " << force("z_low")[2] << ", exact " << exact
      << "\n";
  TEST_COMPARE(norm(force("z_high") - Vec3{0.0, 0.0, exact}), <, 1e-9 * exact);
  TEST_COMPARE(norm(force("z_low") - Vec3{0.0, 0.0, -exact}), <, 1e-9 * exact);
  for (const char* side : {"x_low", "y_low"}) TEST_COMPARE(norm(force(side)), <, 1e-9 * exact);
}

/// The residual of `tracked` is linear, for what steps before make of q is not in the change below.
problems::FluidProblem started_flow(const std::string& stabilisation,
                                    const fields::FieldMesh& field) {
  const auto end = [](const std::string& p) {
    return entry("condition", "string", "pressure") + entry("pressure", "double", p) +
           entry("backflow stabilisation", "double", "0.2");
  };
  return problems::FluidProblem(
      verify::resolved(
          problems::fluid_table(),
          entry("density", "double", "1") + entry("viscosity", "double", "0.1") +
              entry("stabilisation", "string", stabilisation) +
              entry("stabilisation residual", "string",
                    stabilisation == "tracked" ? "linear" : "viscous") +
              entry("time scheme", "string", "implicit euler") +
              sublist("Surfaces",
                      sublist("inlet", end("0.04")) + sublist("outlet", end("0")) +
                          sublist("interface", entry("condition", "string", "no slip"))) +
              sublist("Newton", entry("relative increment", "double", "1e-13")) +
              sublist("Linear Solver", entry("method", "string", "direct"))),
      field);
}

/// Of all elements that the rank counts [mN].
Vec3 change_of_momentum(const fields::FieldMesh& field, const assembly::FluidElements& elements,
                        const assembly::FluidFields& s, const std::vector<Vec3>& subscales) {
  const double rate = elements.coefficients.inv_dt;
  Vec3 change{};
  for (std::size_t e = 0; e < field.tets.size(); ++e) {
    if (!field.is_owned[e]) continue;
    const kernels::Tet4& T = elements.geometry[e];
    Vec3 mean{}, resolved{}, convection{};
    double on_walls = 0.0;
    for (const int node : field.tets[e]) {
      mean += 0.25 * s.u[node];
      resolved += 0.25 * rate * (s.u[node] - s.u_old[node]);
      on_walls += 0.25 * s.on_wall[node];
    }
    for (int k = 0; k < 4; ++k) convection += dot(T.grad_N[k], mean) * s.u[field.tets[e][k]];
    change += T.volume * (resolved + convection + on_walls * rate * (subscales[e] - s.subscale[e]));
  }
  return change;
}

void compare_with_momentum(const std::string& stabilisation, const fields::FieldMesh& field,
                           double dt, double area, Teuchos::FancyOStream& out, bool& success) {
  problems::FluidProblem fluid = started_flow(stabilisation, field);
  assembly::FluidFields s;
  const std::vector<Vec3> nothing(field.n_nodes(), Vec3{});
  s.w = s.f = nothing;
  s.subscale.assign(field.tets.size(), Vec3{});
  s.on_wall.assign(field.n_nodes(), 0.0);
  if (stabilisation == "tracked")
    for (int node = 0; node < field.n_nodes(); ++node)
      if (field.is_on(node, field.surface_index("interface"))) s.on_wall[node] = 1.0;
  Vec3 left{}, total{};
  double drag = 0.0;
  for (stepping::Clock clock(dt, 4); !clock.is_done(); clock.advance()) {
    s.u_old = fields::ghosted_vectors(field, fluid.state()[0]);
    fluid.begin_step(clock);
    TEST_ASSERT(fluid.solve().is_converged);
    s.u = fields::ghosted_vectors(field, fluid.state()[0]);
    s.p = fields::ghosted_scalars(field, fluid.state()[1]);
    fluid.end_step();
    const auto found = fluid.observe_surfaces(fields::bounding_surfaces(field));
    const assembly::FluidElements& elements = fluid.field().elements();
    const std::vector<Vec3> subscales = assembly::fluid_subscales(field, elements, s);
    const Vec3 change = change_of_momentum(field, elements, s, subscales);
    for (int i = 0; i < 3; ++i) left[i] = global_sum(*field.comm, change[i]);
    s.subscale = subscales;
    total = {};
    for (const char* name : {"inlet", "outlet", "interface"})
      total += part(found, "pressure_force", name) + part(found, "viscous_force", name);
    drag = part(found, "viscous_force", "interface")[2];
    TEST_COMPARE(norm(total + left), <, 1e-10 * 0.04 * area);
  }
  out << stabilisation << ", dt " << dt << ": drag " << drag / (0.04 * area)
      << " of pressure drop times area, change of momentum " << left[2] / (0.04 * area) << "\n";
  if (dt > 1.0) TEST_FLOATING_EQUALITY(drag, 0.04 * area, 2e-2);
}

TEUCHOS_UNIT_TEST(surface_forces, forces_and_change_of_momentum_balance) {
  const double R = 1.43, area = 4.0 * R * R * std::sin(std::acos(-1.0) / 4.0);
  const fields::FieldMesh field = verify::lumen(R, 6.0 * R, 1);
  for (const char* stabilisation : {"dynamic", "tracked"})
    for (const double dt : {0.5, 1e4})  // in the middle of the start, and at the end of it
      compare_with_momentum(stabilisation, field, dt, area, out, success);
}

}  // namespace
