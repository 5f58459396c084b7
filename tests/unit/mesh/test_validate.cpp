#include <Teuchos_UnitTestHarness.hpp>
#include <cmath>
#include <limits>
#include <map>

#include "helpers.hpp"
#include "tunica/mesh/validate.hpp"

using namespace tunica::mesh;

namespace {

/// True if the changed smallest tube is refused with this text.
template <typename Change>
bool refuses(const std::string& part, std::ostream& out, Change change) {
  Mesh mesh = make_tube(smallest_tube());
  change(mesh);
  return fails_with(part, out, [&] { validate(mesh, "tube"); });
}

/// The tube with the fluid's own copies of the interface vertices, and their triangles twice.
Mesh torn_tube(const Tube& tube) {
  Mesh mesh = make_tube(tube);
  const int fluid = region_index(mesh, "fluid"), interface = surface_index(mesh, "interface");
  std::map<int, int> copy;
  for (std::size_t i = 0, n = mesh.triangles.size(); i < n; ++i) {
    if (mesh.triangle_surface[i] != interface) continue;
    auto twin = mesh.triangles[i];
    for (int& v : twin) {
      if (copy.emplace(v, static_cast<int>(mesh.vertices.size())).second)
        mesh.vertices.push_back(mesh.vertices[v]);
      v = copy[v];
    }
    mesh.triangles.push_back(twin);
    mesh.triangle_surface.push_back(interface);
  }
  for (std::size_t t = 0; t < mesh.tets.size(); ++t)
    if (mesh.tet_region[t] == fluid)
      for (int& v : mesh.tets[t])
        if (copy.count(v)) v = copy[v];
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
    if (mesh.surfaces[mesh.triangle_surface[i]].name == "inlet" ||
        mesh.surfaces[mesh.triangle_surface[i]].name == "outlet")
      for (int& v : mesh.triangles[i])
        if (copy.count(v)) v = copy[v];
  return mesh;
}

TEUCHOS_UNIT_TEST(mesh_validate, ranges_are_checked) {
  TEST_ASSERT(refuses("tetrahedron 1 has vertex -1", out, [](Mesh& m) { m.tets[1][0] = -1; }));
  TEST_ASSERT(refuses("tetrahedron 1 has vertex 99", out, [](Mesh& m) { m.tets[1][0] = 99; }));
  TEST_ASSERT(refuses("triangle 2 has vertex 99", out, [](Mesh& m) { m.triangles[2][1] = 99; }));
  TEST_ASSERT(refuses("tetrahedron 0 has tag index 3", out, [](Mesh& m) { m.tet_region[0] = 3; }));
  TEST_ASSERT(refuses("tag index -1", out, [](Mesh& m) { m.triangle_surface[0] = -1; }));
  TEST_ASSERT(refuses("elements but", out, [](Mesh& m) { m.triangle_surface.pop_back(); }));
  TEST_ASSERT(refuses("no tetrahedra", out, [](Mesh& m) { m.tets.clear(); }));
}

TEUCHOS_UNIT_TEST(mesh_validate, tags_must_be_unique_and_named) {
  TEST_ASSERT(refuses("have the number 1", out, [](Mesh& m) { m.regions[1].id = 1; }));
  TEST_ASSERT(refuses("are named \"fluid\"", out, [](Mesh& m) { m.regions[1].name = "fluid"; }));
  TEST_ASSERT(refuses("an empty name", out, [](Mesh& m) { m.surfaces[1].name = ""; }));
  TEST_ASSERT(refuses("number -3", out, [](Mesh& m) { m.surfaces[1].id = -3; }));
}

TEUCHOS_UNIT_TEST(mesh_validate, bad_elements_are_named) {
  TEST_ASSERT(refuses("more than once", out, [](Mesh& m) { m.tets[1][0] = m.tets[1][3]; }));
  TEST_ASSERT(refuses("inverted element: tetrahedron 4", out,
                      [](Mesh& m) { std::swap(m.tets[4][0], m.tets[4][1]); }));
  TEST_ASSERT(refuses("degenerate element", out, [](Mesh& m) {
    const auto& t = m.tets[0];
    for (int i = 0; i < 3; ++i)
      m.vertices[t[3]][i] = 0.5 * (m.vertices[t[0]][i] + m.vertices[t[1]][i]);
  }));
  TEST_ASSERT(refuses("belongs to tetrahedra", out, [](Mesh& m) {
    m.tets.push_back(m.tets[10]);
    m.tet_region.push_back(m.tet_region[10]);
  }));
}

TEUCHOS_UNIT_TEST(mesh_validate, overlapping_elements_are_found) {
  Mesh m;
  m.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, 2}};
  m.tets = {{0, 1, 2, 3}, {0, 1, 2, 4}};
  m.tet_region = {0, 0};
  m.regions = {{1, "a"}};
  TEST_ASSERT(fails_with("same side", out, [&] { validate(m, "m"); }));
}

TEUCHOS_UNIT_TEST(mesh_validate, bad_vertices_are_named) {
  const auto add_vertex = [](Mesh& m) { m.vertices.push_back({1, 2, 3}); };
  TEST_ASSERT(refuses("belongs to no tetrahedron", out, add_vertex));
  TEST_ASSERT(refuses("vertex 5 has a coordinate", out, [](Mesh& m) {
    m.vertices[5][1] = std::numeric_limits<double>::quiet_NaN();
  }));
}

TEUCHOS_UNIT_TEST(mesh_validate, outer_faces_must_be_covered_once) {
  TEST_ASSERT(refuses("1 boundary faces belong to no surface", out, [](Mesh& m) {
    m.triangles.pop_back();
    m.triangle_surface.pop_back();
  }));
  TEST_ASSERT(refuses("same vertices as triangle 0", out, [](Mesh& m) {
    m.triangles.push_back(m.triangles[0]);
    m.triangle_surface.push_back(1);
  }));
  TEST_ASSERT(refuses("not a face of any tetrahedron", out, [](Mesh& m) {
    const int last = static_cast<int>(m.vertices.size()) - 1;
    m.triangles.push_back({0, 1, last});
    m.triangle_surface.push_back(1);
  }));
}

TEUCHOS_UNIT_TEST(mesh_validate, triangles_between_two_regions_are_permitted) {
  Tube t = smallest_tube();
  for (const bool with_layer : {true, false}) {
    t.with_layer_surface = with_layer;
    TEST_NOTHROW(validate(make_tube(t), "tube"));
  }
}

TEUCHOS_UNIT_TEST(mesh_validate, unknown_names_get_a_suggestion) {
  const Mesh mesh = make_tube(smallest_tube());
  TEST_EQUALITY(mesh.regions[region_index(mesh, "media")].name, "media");
  TEST_EQUALITY(mesh.surfaces[surface_index(mesh, "outlet")].name, "outlet");
  TEST_ASSERT(fails_with("Did you mean \"fluid\"?", out, [&] { region_index(mesh, "fliud"); }));
  TEST_ASSERT(fails_with("\"struct_in\"", out, [&] { surface_index(mesh, "somewhere"); }));
}

TEUCHOS_UNIT_TEST(mesh_validate, interface_must_lie_between_fluid_and_wall) {
  const Mesh mesh = make_tube(smallest_tube());
  const std::vector<std::string> fluid{"fluid"}, wall{"media", "adventitia"};
  TEST_NOTHROW(check_interface(mesh, fluid, wall, {"interface"}));
  const auto fails = [&](const std::string& part, const std::vector<std::string>& f,
                         const std::vector<std::string>& w, const std::vector<std::string>& s) {
    return fails_with(part, out, [&] { check_interface(mesh, f, w, s); });
  };
  TEST_ASSERT(fails("is both fluid and wall", fluid, {"fluid", "media"}, {"interface"}));
  TEST_ASSERT(fails("lies between regions \"media\" and \"adventitia\"", fluid, wall,
                    {"interface", "layer"}));
  TEST_ASSERT(fails("is not on an interface surface", fluid, wall, {}));
  TEST_ASSERT(fails("nothing on the other", fluid, wall, {"interface", "inlet"}));
}

TEUCHOS_UNIT_TEST(mesh_validate, torn_interface_is_named_with_its_place) {
  const Mesh mesh = torn_tube(smallest_tube());
  TEST_NOTHROW(validate(mesh, "torn"));
  const auto check = [&] {
    check_interface(mesh, {"fluid"}, {"media", "adventitia"}, {"interface"});
  };
  TEST_ASSERT(fails_with("does not conform", out, check));
  TEST_ASSERT(fails_with("\"interface\": the triangle at (", out, check));
}

TEUCHOS_UNIT_TEST(mesh_validate, fluid_and_wall_that_touch_in_an_edge_are_refused) {
  Mesh m;  // wall tetrahedron on a fluid one, and a second wall one that shares an edge only
  m.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, -1}, {-1, 0, 2}, {-1, -1, 2}};
  m.tets = {{0, 1, 2, 3}, {0, 2, 1, 4}, {0, 3, 5, 6}};
  m.tet_region = {0, 1, 1};
  m.regions = {{1, "fluid"}, {2, "wall"}};
  m.surfaces = {{1, "interface"}};
  m.triangles = {{0, 1, 2}};
  m.triangle_surface = {0};
  TEST_ASSERT(fails_with("not on the interface", out,
                         [&] { check_interface(m, {"fluid"}, {"wall"}, {"interface"}); }));
}

}  // namespace
