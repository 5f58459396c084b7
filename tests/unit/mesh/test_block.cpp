#include <Teuchos_UnitTestHarness.hpp>

#include "helpers.hpp"
#include "tunica/mesh/block.hpp"
#include "tunica/mesh/info.hpp"

using namespace tunica::mesh;

namespace {

TEUCHOS_UNIT_TEST(mesh_block, sides_have_their_areas_and_names) {
  const Info info = inspect(make_block({{2.0, 3.0, 5.0}, {2, 3, 4}, {1, 2}}));
  TEST_EQUALITY(info.vertices, 60);
  TEST_EQUALITY(info.tets, 144);
  TEST_FLOATING_EQUALITY(info.regions[0].volume, 30.0, 1e-14);
  const std::map<std::string, double> areas{{"x_low", 15.0},  {"x_high", 15.0}, {"y_low", 10.0},
                                            {"y_high", 10.0}, {"z_low", 6.0},   {"z_high", 4.0},
                                            {"patch", 2.0}};
  TEST_EQUALITY(info.surfaces.size(), areas.size());
  for (const auto& surface : info.surfaces)
    TEST_FLOATING_EQUALITY(surface.area, areas.at(surface.name), 1e-14);
}

TEUCHOS_UNIT_TEST(mesh_block, patch_is_the_corner_of_the_top_at_the_axis) {
  const Mesh mesh = make_block({{2.0, 3.0, 5.0}, {2, 3, 4}, {1, 2}});
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    bool is_in_corner = true;
    for (const int v : mesh.triangles[t]) {
      const tunica::Vec3& x = mesh.vertices[v];
      is_in_corner &= x[0] <= 1.0 && x[1] <= 2.0 && x[2] == 5.0;
    }
    TEST_EQUALITY(mesh.surfaces[mesh.triangle_surface[t]].name == "patch", is_in_corner);
  }
}

TEUCHOS_UNIT_TEST(mesh_block, surfaces_without_triangles_are_left_out) {
  TEST_EQUALITY(make_block({}).surfaces.size(), 6);
  const Mesh all_patch = make_block({{1.0, 1.0, 1.0}, {2, 2, 2}, {2, 2}});
  TEST_EQUALITY(all_patch.surfaces.size(), 6);
  TEST_EQUALITY(all_patch.surfaces.back().name, "patch");
}

TEUCHOS_UNIT_TEST(mesh_block, options_out_of_range_are_named) {
  const auto fails = [&](const Block& block, const std::string& part) {
    TEST_ASSERT(fails_with(part, out, [&] { make_block(block); }));
  };
  fails({{1.0, -1.0, 1.0}, {2, 2, 2}, {0, 0}}, "size along y is -1");
  fails({{1.0, 1.0, 1.0}, {2, 2, 0}, {0, 0}}, "cells along z are 0");
  fails({{1.0, 1.0, 1.0}, {2, 2, 2}, {3, 1}}, "3 cells along x");
  fails({{1.0, 1.0, 1.0}, {2, 2, 2}, {0, 1}}, "one axis only");
  fails({{1.0, 1.0, 1.0}, {10000, 10000, 10}, {0, 0}}, "fewer than 2e8");
}

}  // namespace
