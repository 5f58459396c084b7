#include <Teuchos_UnitTestHarness.hpp>
#include <algorithm>
#include <cmath>
#include <map>

#include "tunica/mesh/block.hpp"
#include "tunica/problems/mesh_motion.hpp"
#include "tunica/stepping/implicit_euler.hpp"
#include "unit/problems/lists.hpp"
#include "unit/problems/shape.hpp"

namespace {

using namespace tunica;

const stepping::ImplicitEuler euler(1);

struct Law {
  std::string name;
  double stiffening;
};
const std::vector<Law> all_laws{
    {"harmonic", 0.0}, {"harmonic", 1.0}, {"elastic", 0.0}, {"elastic", 0.7}};

Teuchos::ParameterList list_of(const Law& law) {
  Teuchos::ParameterList list;
  list.set("law", law.name).set("stiffening", law.stiffening);
  list.sublist("Linear Solver").set("method", "cg");
  return test::resolved(list, problems::mesh_motion_table());
}

/// A block with cells between these planes z, and this many along x and y.
struct Layers {
  Layers(std::vector<double> at, std::array<int, 2> cells, double width = 1.0,
         const CommPtr& comm = test::world())
      : planes(std::move(at)), mesh(made(planes, cells, width)),
        share(test::share_of(mesh, {true}, comm)), field(fields::make_field_mesh(share, {0})) {}

  static mesh::Mesh made(const std::vector<double>& planes, std::array<int, 2> cells,
                         double width) {
    const int n = static_cast<int>(planes.size()) - 1;
    mesh::Mesh block =
        mesh::make_block({{width, 1.5, static_cast<double>(n)}, {cells[0], cells[1], n}});
    for (Vec3& x : block.vertices) x[2] = planes[static_cast<int>(std::lround(x[2]))];
    return block;
  }
  std::vector<int> surfaces(const std::vector<const char*>& names) const {
    std::vector<int> found;
    for (const char* name : names) found.push_back(mesh::surface_index(mesh, name));
    return found;
  }

  std::vector<double> planes;
  mesh::Mesh mesh;
  mesh::Share share;
  fields::FieldMesh field;
};

const std::vector<const char*> sides{"y_low", "y_high", "z_low", "z_high"};

/// The displacement that follows from that of the interface.
std::vector<Vec3> moved(const Layers& block, const Law& law, const std::vector<int>& interface,
                        const std::vector<int>& staying, const std::function<Vec3(const Vec3&)>& d,
                        Teuchos::FancyOStream& out, bool& success) {
  problems::MeshMotion motion(list_of(law), block.field, interface, staying, euler);
  std::vector<Vec3> given(block.field.n_owned);
  for (int a = 0; a < block.field.n_owned; ++a) given[a] = d(block.field.x[a]);
  TEST_ASSERT(motion.extend(given).is_success());
  return motion.displacement();
}

TEUCHOS_UNIT_TEST(following_surfaces, planes_take_the_affine_displacement_of_their_rims) {
  const Layers slab({0.0, 0.5, 1.0, 1.5, 2.0}, {1, 4});
  const auto affine = [](const Vec3& x) {
    return Vec3{0.1 * x[0] - 0.02 * x[2], 0.3 + 0.05 * x[1] + 0.01 * x[0],
                0.04 * x[2] - 0.1 * x[1]};
  };
  for (const Law& law : all_laws) {
    const auto d = moved(slab, law, slab.surfaces(sides), {}, affine, out, success);
    for (int a = 0; a < slab.field.n_owned; ++a)
      TEST_COMPARE(norm(d[a] - affine(slab.field.x[a])), <, 1e-10);
  }
}

// Where d depends on z alone, stresses are the same in all layers, and strains as 1/γ: as A^(3χ/2)
// of the triangles, whose areas are as the heights of layers, and as h^(3χ) along lines.
TEUCHOS_UNIT_TEST(following_surfaces, layers_are_strained_by_their_stiffness) {
  const Layers block({0.0, 0.2, 0.5, 1.1}, {2, 3});
  const auto part = [&](double z, double exponent) {
    double below = 0.0, whole = 0.0;
    for (std::size_t k = 1; k < block.planes.size(); ++k) {
      const double strained = std::pow(block.planes[k] - block.planes[k - 1], 1.0 + exponent);
      whole += strained;
      if (block.planes[k] < z + 1e-9) below += strained;
    }
    return below / whole;
  };
  const Vec3 top{0.02, 0.03, 0.05};
  for (const Law& law : all_laws)
    for (const bool has_lines : {false, true}) {
      const double exponent = (has_lines ? 3.0 : 1.5) * law.stiffening;
      const auto along = [&](const Vec3& x) { return part(x[2], exponent) * top; };
      const auto interface =
          has_lines ? block.surfaces({"z_low", "z_high"}) : block.surfaces(sides);
      const auto d = moved(block, law, interface, {}, along, out, success);
      double found = 0.0;
      for (int a = 0; a < block.field.n_owned; ++a) {
        const Vec3& x = block.field.x[a];
        const bool is_on_x = x[0] == 0.0 || x[0] == 1.0, is_on_y = x[1] == 0.0 || x[1] == 1.5;
        if (!is_on_x || (has_lines && !is_on_y)) continue;
        TEST_COMPARE(norm(d[a] - along(x)), <, 1e-10);
        ++found;
      }
      TEST_EQUALITY(global_sum(*test::world(), found), has_lines ? 16.0 : 32.0);
    }
}

// All of a slab of one cell lies on its planes of symmetry.
TEUCHOS_UNIT_TEST(following_surfaces, a_slab_is_kept_in_shape_as_a_volume_is_on_any_ranks) {
  const std::vector<double> planes{0.0, 0.05, 0.15, 0.35, 0.75, 1.55};
  const Layers slab(planes, {1, 12});
  const Layers alone(planes, {1, 12}, 1.0, Teuchos::rcp(new Teuchos::MpiComm<int>(MPI_COMM_SELF)));
  const auto bump = [](const Vec3& x) {
    return Vec3{0.0, 0.0, 0.5 * std::pow(std::sin(M_PI * x[1] / 1.5), 2)};
  };
  const auto of = [&](const Layers& block, const Law& law) {
    return moved(block, law, block.surfaces({"z_low"}),
                 block.surfaces({"y_low", "y_high", "z_high"}), bump, out, success);
  };
  const auto least = [&](const Law& law) {
    const std::vector<Vec3> d = of(slab, law), serial = of(alone, law);
    std::map<int, Vec3> at;
    for (int a = 0; a < alone.field.n_nodes(); ++a) at[alone.field.vertex[a]] = serial[a];
    for (int a = 0; a < slab.field.n_nodes(); ++a) {
      TEST_COMPARE(norm(d[a] - at.at(slab.field.vertex[a])), <, 1e-9);
      TEST_COMPARE(std::abs(d[a][0]), <, 1e-14);  // planes of symmetry stay plane
    }
    return test::least_part_of_volume(slab.field, d);
  };
  TEST_COMPARE(least({"harmonic", 0.0}), <, 0.0);
  TEST_COMPARE(least({"harmonic", 1.0}), >, 0.2);
  TEST_COMPARE(least({"elastic", 0.0}), >, 0.1);
  TEST_COMPARE(least({"elastic", 1.0}), >, 0.3);
}

// A bump that a plane of symmetry cuts: its half is kept in shape as the whole is.
TEUCHOS_UNIT_TEST(following_surfaces, half_a_model_is_as_valid_as_the_whole) {
  const std::vector<double> planes{0.0, 0.05, 0.15, 0.35, 0.75, 1.55};
  const Layers half(planes, {4, 6}), whole(planes, {8, 6}, 2.0);
  const auto of = [&](const Layers& block, double centre, const Law& law) {
    const auto bump = [centre](const Vec3& x) {
      const double s = std::cos(0.5 * M_PI * (x[0] - centre)) * std::sin(M_PI * x[1] / 1.5);
      return Vec3{0.0, 0.0, 0.5 * s * s};
    };
    std::vector<int> staying = block.surfaces({"x_high", "y_low", "y_high", "z_high"});
    if (&block == &whole) staying.push_back(block.surfaces({"x_low"})[0]);
    const auto d = moved(block, law, block.surfaces({"z_low"}), staying, bump, out, success);
    return test::least_part_of_volume(block.field, d);
  };
  TEST_COMPARE(of(whole, 1.0, {"harmonic", 0.0}), <, 0.0);
  for (const Law& law : {Law{"harmonic", 1.0}, Law{"elastic", 0.0}, Law{"elastic", 1.0}}) {
    const double of_whole = of(whole, 1.0, law);
    TEST_COMPARE(of_whole, >, 0.1);
    TEST_COMPARE(of(half, 0.0, law), >, 0.9 * of_whole);
  }
}

}  // namespace
