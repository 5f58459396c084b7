#include <Teuchos_UnitTestHarness.hpp>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "tunica/mesh/block.hpp"
#include "tunica/problems/mesh_motion.hpp"
#include "tunica/stepping/implicit_euler.hpp"
#include "unit/problems/lists.hpp"
#include "unit/problems/shape.hpp"

namespace {

using namespace tunica;
using test::SmallTube;

Teuchos::ParameterList solved_by(const std::string& method, const std::string& law = "harmonic",
                                 double stiffening = 0.0) {
  Teuchos::ParameterList list;
  list.set("law", law).set("stiffening", stiffening);
  list.sublist("Linear Solver").set("method", method);
  return test::resolved(list, problems::mesh_motion_table());
}

Vec3 linear_field(const Vec3& x) {
  return {0.1 * x[0] - 0.02 * x[2], 0.3 + 0.05 * x[1] + 0.01 * x[0], 0.04 * x[2]};
}

const stepping::ImplicitEuler scheme(1);

/// A block with cells between these planes z.
struct Block {
  explicit Block(std::vector<double> at = {0.0, 0.5, 1.0, 1.5, 2.0}, bool has_core = false)
      : planes(std::move(at)), mesh(made(planes, has_core)), share(test::share_of(mesh, {true})),
        field(fields::make_field_mesh(share, {0})) {}

  /// has_core: what of the top does not touch its edges is a surface of its own.
  static mesh::Mesh made(const std::vector<double>& planes, bool has_core) {
    const int n = static_cast<int>(planes.size()) - 1;
    mesh::Mesh block = mesh::make_block({{1.0, 1.5, static_cast<double>(n)}, {3, 4, n}});
    for (Vec3& x : block.vertices) x[2] = planes[static_cast<int>(std::lround(x[2]))];
    if (!has_core) return block;
    const int top = mesh::surface_index(block, "z_high");
    block.surfaces.push_back({static_cast<int>(block.surfaces.size()) + 1, "core"});
    for (std::size_t t = 0; t < block.triangles.size(); ++t) {
      if (block.triangle_surface[t] != top) continue;
      bool is_inside = true;
      for (const int v : block.triangles[t]) {
        const Vec3& x = block.vertices[v];
        is_inside = is_inside && x[0] > 0.0 && x[0] < 1.0 && x[1] > 0.0 && x[1] < 1.5;
      }
      if (is_inside) block.triangle_surface[t] = static_cast<int>(block.surfaces.size()) - 1;
    }
    return block;
  }
  int surface(const std::string& name) const { return mesh::surface_index(mesh, name); }

  std::vector<double> planes;
  mesh::Mesh mesh;
  mesh::Share share;
  fields::FieldMesh field;
};

double largest(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  double found = 0.0;
  for (std::size_t k = 0; k < a.size(); ++k) found = std::max(found, norm(a[k] - b[k]));
  return global_max(*test::world(), found);
}

TEUCHOS_UNIT_TEST(mesh_motion, a_linear_field_on_the_whole_boundary_is_reproduced_inside) {
  const SmallTube tube;
  for (const auto& list : {solved_by("cg"), solved_by("direct"), solved_by("cg", "elastic", 1.0),
                           solved_by("direct", "elastic")}) {
    problems::MeshMotion motion(
        list, tube.fluid,
        {tube.surface("inlet"), tube.surface("outlet"), tube.surface("interface")}, {}, scheme);
    std::vector<Vec3> given(tube.fluid.n_owned), expected(tube.fluid.n_nodes());
    for (int a = 0; a < tube.fluid.n_nodes(); ++a) expected[a] = linear_field(tube.fluid.x[a]);
    for (int a = 0; a < tube.fluid.n_owned; ++a)
      given[a] = tube.fluid.is_on_boundary(a) ? expected[a] : Vec3{7, 7, 7};  // 7 is ignored
    TEST_ASSERT(motion.extend(given).is_success());
    TEST_COMPARE(largest(motion.displacement(), expected), <, 1e-10);
  }
}

// What is left undone is a part of the increment, and gone when it has been asked for often enough.
TEUCHOS_UNIT_TEST(mesh_motion, an_increment_is_followed_as_well_as_is_asked) {
  std::vector<double> planes;
  for (int k = 0; k <= 500; ++k) planes.push_back(0.5 * k);  // else one level solves it
  const Block block(planes);
  std::vector<int> all(block.mesh.surfaces.size());
  std::iota(all.begin(), all.end(), 0);
  const double increment = 1e-2, reduction = 0.03;
  for (const auto& list : {solved_by("cg"), solved_by("cg", "elastic")}) {
    problems::MeshMotion motion(list, block.field, all, {}, scheme);
    std::vector<Vec3> given(block.field.n_owned), expected(block.field.n_nodes());
    double tiny = 1e-10;  // a component that is no measure of the others
    const auto error_after = [&](double factor, const problems::ExtensionAccuracy& accuracy) {
      for (int a = 0; a < block.field.n_nodes(); ++a)
        expected[a] = factor * linear_field(block.field.x[a]);
      tiny = -tiny;
      for (Vec3& d : expected) d[1] *= tiny;
      std::copy_n(expected.begin(), given.size(), given.begin());
      TEST_ASSERT(motion.extend(given, accuracy).is_success());
      return largest(motion.displacement(), expected) /
             largest(expected, std::vector<Vec3>(expected.size()));
    };
    TEST_COMPARE(error_after(1.0, {}), <, 1e-10);
    const double once = error_after(1.0 + increment, {1e-8, reduction});
    TEST_COMPARE(once, >, 1e-6);
    TEST_COMPARE(once, <, 0.1 * increment);
    double last = once;
    for (int k = 0; k < 5; ++k) last = error_after(1.0 + increment, {1e-8, reduction});
    TEST_COMPARE(last, <, 2e-8);
  }
}

TEUCHOS_UNIT_TEST(mesh_motion, openings_stretch_with_their_rims_and_surfaces_at_rest_stay) {
  const SmallTube tube;
  const int inlet = tube.surface("inlet"), outlet = tube.surface("outlet"),
            interface = tube.surface("interface");
  problems::MeshMotion motion(solved_by("cg"), tube.fluid, {interface}, {outlet}, scheme);
  std::vector<Vec3> given(tube.fluid.n_owned);
  for (int a = 0; a < tube.fluid.n_owned; ++a) given[a] = linear_field(tube.fluid.x[a]);
  TEST_ASSERT(motion.extend(given).is_success());
  const auto& d = motion.displacement();
  bool moves_inside = false;
  for (int a = 0; a < tube.fluid.n_nodes(); ++a) {
    const Vec3 expected = linear_field(tube.fluid.x[a]);
    if (tube.fluid.is_on(a, interface))
      TEST_ASSERT(d[a] == expected)
    else if (tube.fluid.is_on(a, inlet))
      TEST_COMPARE(norm(d[a] - expected), <, 1e-10)
    else if (tube.fluid.is_on(a, outlet))
      TEST_ASSERT(d[a] == Vec3{})
    else
      moves_inside = moves_inside || norm(d[a]) > 1e-3;
  }
  TEST_ASSERT(global_max(*test::world(), moves_inside) > 0.5);
  TEST_ASSERT(motion.extend(std::vector<Vec3>(tube.fluid.n_owned)).is_success());
  TEST_COMPARE(largest(motion.displacement(), std::vector<Vec3>(d.size())), <, 1e-12);
}

// The bottom of a block is stretched in its plane and its top stays: as it is told, or as its
// corners do. The line around a core hangs on nothing.
TEUCHOS_UNIT_TEST(mesh_motion, surfaces_that_meet_stretch_along_the_lines_between_them) {
  for (const bool is_told : {true, false}) {
    const Block block({0.0, 0.5, 1.0, 1.5, 2.0}, !is_told);
    const std::vector<int> staying(is_told ? 1 : 0, block.surface("z_high"));
    problems::MeshMotion motion(solved_by("cg"), block.field, {block.surface("z_low")}, staying,
                                scheme);
    const auto bottom = [](const Vec3& x) { return Vec3{0.1 * x[0], -0.05 * x[1], 0.0}; };
    std::vector<Vec3> given(block.field.n_owned), expected(block.field.n_nodes());
    for (int a = 0; a < block.field.n_owned; ++a) given[a] = bottom(block.field.x[a]);
    // (1 − z/h) of it is harmonic on lines, surfaces and in the volume, also between the vertices
    for (int a = 0; a < block.field.n_nodes(); ++a)
      expected[a] = (1.0 - block.field.x[a][2] / block.planes.back()) * bottom(block.field.x[a]);
    TEST_ASSERT(motion.extend(given).is_success());
    TEST_COMPARE(largest(motion.displacement(), expected), <, 1e-10);
  }
}

// Between two planes the flux of γ ∇φ is the same in all layers: strains are as V^χ.
TEUCHOS_UNIT_TEST(mesh_motion, stiffer_elements_are_strained_less) {
  const Block block({0.0, 0.1, 0.3, 0.7, 1.5});
  const fields::FieldMesh& mesh = block.field;
  for (const double exponent : {0.0, 1.0, 1.5}) {
    std::vector<char> given(mesh.n_nodes());
    MultiVector phi(mesh.node_map, 1);
    for (int a = 0; a < mesh.n_nodes(); ++a)
      given[a] = mesh.is_on_any(a, {block.surface("z_low"), block.surface("z_high")});
    {
      const auto view = phi.getLocalViewHost(overwrite_all);
      for (int a = 0; a < mesh.n_owned; ++a)
        view(a, 0) = mesh.is_on(a, block.surface("z_high")) ? 1.0 : 0.0;
    }
    const discretisation::HarmonicExtension extension(mesh, given, discretisation::Extent::volume,
                                                      exponent);
    problems::ExtensionProblem harmonic(solved_by("direct").sublist("Linear Solver"), extension, 1);
    TEST_ASSERT(harmonic.extend(phi).is_success());
    const std::vector<double> value = fields::ghosted_scalars(mesh, *phi.getVector(0));
    double whole = 0.0;
    for (std::size_t k = 1; k < block.planes.size(); ++k)
      whole += std::pow(block.planes[k] - block.planes[k - 1], 1.0 + exponent);
    for (int a = 0; a < mesh.n_nodes(); ++a) {
      double below = 0.0;
      for (std::size_t k = 1; k < block.planes.size() && block.planes[k] < mesh.x[a][2] + 1e-9; ++k)
        below += std::pow(block.planes[k] - block.planes[k - 1], 1.0 + exponent);
      TEST_COMPARE(std::abs(value[a] - below / whole), <, 1e-10);
    }
  }
}

TEUCHOS_UNIT_TEST(mesh_motion, a_bump_inverts_small_elements_unless_they_are_stiffer_or_elastic) {
  const Block block({0.0, 0.05, 0.15, 0.35, 0.75, 1.55});
  const fields::FieldMesh& mesh = block.field;
  std::vector<int> walls;
  for (const char* name : {"x_low", "x_high", "y_low", "y_high", "z_high"})
    walls.push_back(block.surface(name));
  std::vector<Vec3> bump(mesh.n_owned);
  for (int a = 0; a < mesh.n_owned; ++a) {
    const double s = std::sin(M_PI * mesh.x[a][0]) * std::sin(M_PI * mesh.x[a][1] / 1.5);
    bump[a] = {0.0, 0.0, 0.5 * s * s};
  }
  const auto least_part = [&](const std::string& law, double stiffening) {
    problems::MeshMotion motion(solved_by("cg", law, stiffening), mesh, {block.surface("z_low")},
                                walls, scheme);
    TEST_ASSERT(motion.extend(bump).is_success());
    return test::least_part_of_volume(mesh, motion.displacement());
  };
  TEST_COMPARE(least_part("harmonic", 0.0), <, 0.0);
  TEST_COMPARE(least_part("harmonic", 1.0), >, 0.2);
  TEST_COMPARE(least_part("elastic", 0.0), >, 0.1);
  TEST_COMPARE(least_part("elastic", 1.0), >, 0.4);
  TEST_COMPARE(least_part("elastic", 3.0), >, 0.1);  // moduli of 1 to 3e4
}

// Drawn by its ends, which are free to contract: a bar becomes thinner by ν.
TEUCHOS_UNIT_TEST(mesh_motion, an_elastic_mesh_contracts_by_poissons_ratio) {
  const Block block({0.0, 0.4, 1.0, 2.0});
  const fields::FieldMesh& mesh = block.field;
  constexpr double poisson = 0.25;
  const auto drawn = [](const Vec3& x) {
    return Vec3{-poisson * 0.1 * x[0], -poisson * 0.1 * x[1], 0.1 * x[2]};
  };
  std::vector<char> given(mesh.n_nodes());
  for (int a = 0; a < mesh.n_nodes(); ++a)
    given[a] = mesh.is_on_any(a, {block.surface("z_low"), block.surface("z_high")});
  const discretisation::ElasticExtension extension(mesh, given, discretisation::Extent::volume,
                                                   poisson, 0.0);
  for (const std::string method : {"cg", "direct"}) {
    problems::ExtensionProblem problem(solved_by(method).sublist("Linear Solver"), extension);
    MultiVector d(mesh.node_map, 3);
    {
      const auto view = d.getLocalViewHost(overwrite_all);
      for (int a = 0; a < mesh.n_owned; ++a)
        for (int i = 0; i < 3; ++i) view(a, i) = given[a] ? drawn(mesh.x[a])[i] : 0.0;
    }
    TEST_ASSERT(problem.extend(d).is_success());
    const auto view = d.getLocalViewHost(read_only);
    for (int a = 0; a < mesh.n_owned; ++a)
      for (int i = 0; i < 3; ++i) TEST_COMPARE(std::abs(view(a, i) - drawn(mesh.x[a])[i]), <, 1e-9);
  }
}

TEUCHOS_UNIT_TEST(mesh_motion, increments_are_differences_of_extensions) {
  const SmallTube tube;
  const fields::FieldMesh& mesh = tube.fluid;
  for (const std::string law : {"harmonic", "elastic"}) {
    problems::MeshMotion motion(solved_by("cg", law, 0.5), mesh, {tube.surface("interface")},
                                {tube.surface("outlet")}, scheme);
    Vector increment(mesh.vector_map), moved(mesh.vector_map);
    std::vector<Vec3> given(mesh.n_owned), added(mesh.n_owned);
    for (int a = 0; a < mesh.n_owned; ++a) {
      given[a] = linear_field(mesh.x[a]);
      for (int i = 0; i < 3; ++i) added[a][i] = 0.1 * test::scatter(4.0 * mesh.vertex[a] + i);
    }
    fields::store(added, mesh, increment);
    motion.extend_increment(1e-12, increment, moved);
    TEST_ASSERT(motion.extend(given).is_success());
    std::vector<Vec3> expected = motion.displacement();
    for (int a = 0; a < mesh.n_owned; ++a) given[a] += added[a];
    TEST_ASSERT(motion.extend(given).is_success());
    const std::vector<Vec3> d = fields::ghosted_vectors(mesh, moved);
    for (std::size_t a = 0; a < d.size(); ++a) expected[a] += d[a];
    TEST_COMPARE(largest(motion.displacement(), expected), <, 1e-10);
  }
}

TEUCHOS_UNIT_TEST(mesh_motion, the_tolerance_asked_for_is_enough_and_no_number_is_a_failure) {
  const SmallTube tube;
  const std::vector<Vec3> given(tube.fluid.n_owned, Vec3{0.01, 0.02, 0.03});
  Teuchos::ParameterList loose = solved_by("cg");
  loose.sublist("Linear Solver").set("tolerance", 1e-4);
  problems::MeshMotion coarse(loose, tube.fluid, {tube.surface("interface")}, {}, scheme);
  TEST_ASSERT(coarse.extend(given).is_success());
  problems::MeshMotion motion(solved_by("cg"), tube.fluid, {tube.surface("interface")}, {}, scheme);
  const std::vector<Vec3> nowhere(tube.fluid.n_owned, Vec3{std::nan(""), 0, 0});
  TEST_ASSERT(motion.extend(nowhere).reason().find("relative residual") != std::string::npos);
}

TEUCHOS_UNIT_TEST(mesh_motion, the_old_displacement_is_that_of_the_last_accepted_step) {
  const SmallTube tube;
  problems::MeshMotion motion(solved_by("direct"), tube.fluid, {tube.surface("interface")}, {},
                              scheme);
  const std::vector<Vec3> zero(tube.fluid.n_nodes());
  const std::vector<Vec3> given(tube.fluid.n_owned, Vec3{0.01, 0.02, 0.03});
  TEST_ASSERT(motion.extend(given).is_success());
  const std::vector<Vec3> first = motion.displacement();
  TEST_EQUALITY(largest(motion.old_displacement(), zero), 0.0);
  motion.end_step();
  TEST_ASSERT(motion.extend(std::vector<Vec3>(tube.fluid.n_owned)).is_success());
  TEST_EQUALITY(largest(motion.old_displacement(), first), 0.0);
  TEST_COMPARE(largest(motion.displacement(), zero), <, 1e-12);
}

TEUCHOS_UNIT_TEST(mesh_motion, goes_on_from_a_saved_state) {
  const SmallTube tube;
  problems::MeshMotion motion(solved_by("cg"), tube.fluid, {tube.surface("interface")}, {}, scheme);
  problems::MeshMotion other(solved_by("cg"), tube.fluid, {tube.surface("interface")}, {}, scheme);
  std::vector<Vec3> given(tube.fluid.n_owned);
  for (int a = 0; a < tube.fluid.n_owned; ++a) given[a] = linear_field(tube.fluid.x[a]);
  TEST_ASSERT(motion.extend(given).is_success());
  motion.end_step();
  TEST_EQUALITY(other.restore(motion.save()), "");
  TEST_ASSERT(other.displacement() == motion.displacement());
  TEST_ASSERT(other.old_displacement() == motion.old_displacement());
  for (Vec3& d : given) d = 1.1 * d;
  TEST_ASSERT(motion.extend(given).is_success() && other.extend(given).is_success());
  TEST_COMPARE(largest(other.displacement(), motion.displacement()), <, 1e-13);
}

TEUCHOS_UNIT_TEST(mesh_motion, solves_the_equation_of_its_law) {
  const SmallTube tube;
  std::vector<char> is_given;
  for (int a = 0; a < tube.fluid.n_nodes(); ++a) is_given.push_back(tube.fluid.is_on_boundary(a));
  const discretisation::HarmonicExtension harmonic(tube.fluid, is_given,
                                                   discretisation::Extent::volume, 0.5);
  const discretisation::ElasticExtension elastic(tube.fluid, is_given,
                                                 discretisation::Extent::volume, 0.1, 0.5);
  for (const std::string law : {"harmonic", "elastic"}) {
    Teuchos::ParameterList list;
    list.set("law", law).set("stiffening", 0.5);
    if (law == "elastic") list.set("poisson ratio", 0.1);
    list.sublist("Linear Solver").set("method", "direct");
    problems::MeshMotion motion(test::resolved(list, problems::mesh_motion_table()), tube.fluid,
                                {tube.surface("interface")}, {}, scheme);
    std::vector<Vec3> given(tube.fluid.n_owned);
    for (int a = 0; a < tube.fluid.n_owned; ++a)
      if (tube.fluid.is_on(a, tube.surface("interface"))) given[a] = linear_field(tube.fluid.x[a]);
    TEST_ASSERT(motion.extend(given).is_success());
    MultiVector d(tube.fluid.node_map, 3), F(tube.fluid.node_map, 3);
    const auto set = [&](bool is_whole) {
      const auto view = d.getLocalViewHost(Tpetra::Access::OverwriteAll);
      for (int a = 0; a < tube.fluid.n_owned; ++a)
        for (int i = 0; i < 3; ++i)
          view(a, i) = is_whole || is_given[a] ? motion.displacement()[a][i] : 0.0;
    };
    const auto size_of = [&](bool is_whole) {
      set(is_whole);
      law == "elastic" ? elastic.residual(d, F) : harmonic.residual(d, F);
      std::vector<double> norms(3);
      F.normInf(Teuchos::arrayViewFromVector(norms));
      return *std::max_element(norms.begin(), norms.end());
    };
    TEST_COMPARE(size_of(true), <, 1e-11);
    TEST_COMPARE(size_of(false), >, 1e-3);
  }
}

}  // namespace
