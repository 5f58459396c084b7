#include <Teuchos_UnitTestHarness.hpp>
#include <cmath>
#include <set>

#include "helpers.hpp"
#include "tunica/mesh/info.hpp"
#include "tunica/mesh/validate.hpp"

using namespace tunica::mesh;

namespace {

/// Cross-section between two regular polygons of n corners on circles.
double polygon_ring(int n, double inner, double outer) {
  return 0.5 * n * std::sin(2.0 * pi / n) * (outer * outer - inner * inner);
}

double exact_volume(const Tube& t, const std::string& region) {
  const double a = t.radius, b = a + t.media, c = b + t.adventitia;
  const double section = region == "fluid"   ? a * a
                         : region == "media" ? b * b - a * a
                                             : c * c - b * b;
  return pi * section * t.length;
}

TEUCHOS_UNIT_TEST(mesh_tube, volumes_are_those_of_the_polygon) {
  Tube t;
  for (const int rings : {0, 1, 3}) {
    t.rings = rings;
    t.ring_grading = 0.5;
    t.axial_grading = 2.0;
    const Info info = inspect(make_tube(t));
    const double r = t.radius, m = r + t.media, o = m + t.adventitia;
    TEST_FLOATING_EQUALITY(info.regions[0].volume, t.length * polygon_ring(t.around, 0, r), 1e-12);
    TEST_FLOATING_EQUALITY(info.regions[1].volume, t.length * polygon_ring(t.around, r, m), 1e-12);
    TEST_FLOATING_EQUALITY(info.regions[2].volume, t.length * polygon_ring(t.around, m, o), 1e-12);
  }
}

TEUCHOS_UNIT_TEST(mesh_tube, volumes_converge_to_the_cylinder_with_second_order) {
  Tube coarse, fine;
  coarse.around = 16;
  fine.around = 32;
  coarse.axial = fine.axial = 4;
  const Info a = inspect(make_tube(coarse)), b = inspect(make_tube(fine));
  for (int r = 0; r < 3; ++r) {
    const double exact = exact_volume(coarse, a.regions[r].name);
    TEST_FLOATING_EQUALITY((exact - a.regions[r].volume) / (exact - b.regions[r].volume), 4.0,
                           0.03);
  }
}

TEUCHOS_UNIT_TEST(mesh_tube, faces_match_and_the_interface_conforms) {
  for (const int around : {4, 8, 12, 20})
    for (const int rings : {0, 2}) {
      Tube t;
      t.around = around;
      t.rings = rings;
      t.axial = 3;
      const Mesh mesh = make_tube(t);
      TEST_NOTHROW(validate(mesh, "tube"));
      TEST_NOTHROW(check_interface(mesh, {"fluid"}, {"media", "adventitia"}, {"interface"}));
      const Info info = inspect(mesh);
      TEST_EQUALITY(info.euler(), 1);
      TEST_EQUALITY(info.pieces, 1);
      TEST_EQUALITY(info.twin_vertices, 0);
    }
}

TEUCHOS_UNIT_TEST(mesh_tube, tags_are_complete) {
  const Mesh mesh = make_tube(smallest_tube());
  TEST_ASSERT((names(mesh.regions) == std::set<std::string>{"fluid", "media", "adventitia"}));
  TEST_ASSERT(
      (names(mesh.surfaces) == std::set<std::string>{"inlet", "outlet", "interface", "struct_in",
                                                     "struct_out", "outer", "layer"}));
  const Info info = inspect(mesh);
  for (const auto& surface : info.surfaces)
    TEST_EQUALITY(
        surface.neighbours.size(),
        surface.name == "inlet" || surface.name == "outlet" || surface.name == "outer" ? 1u : 2u);
}

TEUCHOS_UNIT_TEST(mesh_tube, wall_alone_is_a_pipe) {
  Tube t;
  t.with_lumen = false;
  t.with_layer_surface = false;
  const Mesh mesh = make_tube(t);
  TEST_ASSERT((names(mesh.regions) == std::set<std::string>{"media", "adventitia"}));
  TEST_ASSERT((names(mesh.surfaces) ==
               std::set<std::string>{"interface", "struct_in", "struct_out", "outer"}));
  TEST_EQUALITY(inspect(mesh).euler(), 0);
}

TEUCHOS_UNIT_TEST(mesh_tube, lumen_alone_is_a_cylinder) {
  Tube t;
  t.with_wall = false;
  const Mesh mesh = make_tube(t);
  TEST_ASSERT((names(mesh.surfaces) == std::set<std::string>{"inlet", "outlet", "interface"}));
  TEST_EQUALITY(inspect(mesh).euler(), 1);
}

TEUCHOS_UNIT_TEST(mesh_tube, single_layer_has_no_layer_surface) {
  Tube t;
  t.adventitia_layers = 0;
  const Mesh mesh = make_tube(t);
  TEST_ASSERT((names(mesh.regions) == std::set<std::string>{"fluid", "media"}));
  TEST_EQUALITY(names(mesh.surfaces).count("layer"), 0u);
  TEST_FLOATING_EQUALITY(inspect(mesh).high[2], t.length, 1e-14);
}

TEUCHOS_UNIT_TEST(mesh_tube, same_options_give_the_same_mesh) {
  TEST_ASSERT(are_identical(make_tube(Tube()), make_tube(Tube())));
}

TEUCHOS_UNIT_TEST(mesh_tube, bad_options_are_named) {
  const auto fails = [&](const std::string& part, auto change) {
    Tube t;
    change(t);
    return fails_with(part, out, [&] { make_tube(t); });
  };
  TEST_ASSERT(fails("radius is -1", [](Tube& t) { t.radius = -1; }));
  TEST_ASSERT(fails("length is nan", [](Tube& t) { t.length = std::nan(""); }));
  TEST_ASSERT(fails("multiple of 4", [](Tube& t) { t.around = 10; }));
  TEST_ASSERT(fails("axial is 0", [](Tube& t) { t.axial = 0; }));
  TEST_ASSERT(fails("rings is -1", [](Tube& t) { t.rings = -1; }));
  TEST_ASSERT(fails("ring grading is 0", [](Tube& t) { t.ring_grading = 0; }));
  TEST_ASSERT(fails("no layers", [](Tube& t) { t.media_layers = t.adventitia_layers = 0; }));
  TEST_ASSERT(fails("neither lumen nor wall", [](Tube& t) { t.with_lumen = t.with_wall = false; }));
  TEST_ASSERT(fails("fewer than 2e8", [](Tube& t) { t.around = t.axial = 40000; }));
}

}  // namespace
