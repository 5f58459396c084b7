#include <Teuchos_UnitTestHarness.hpp>

#include "helpers.hpp"
#include "tunica/mesh/faces.hpp"
#include "tunica/mesh/plane_mesh.hpp"
#include "tunica/mesh/validate.hpp"

using namespace tunica;
using namespace tunica::mesh;

namespace {

// Two squares of two triangles each, beside each other, and a point of no triangle.
//
//   4 -- 5 -- 6
//   |  / |  / |
//   1 -- 2 -- 3
const std::string names =
    "$PhysicalNames\n5\n1 1 \"inlet\"\n1 2 \"walls\"\n1 3 \"between\"\n"
    "2 1 \"fluid\"\n2 2 \"beam\"\n$EndPhysicalNames\n";
std::string version_22(const std::string& lines =
                           "1 1 2 1 1 1 4\n2 1 2 2 2 1 2\n3 1 2 2 2 4 5\n"
                           "4 1 2 3 3 2 5\n5 1 2 2 2 2 3\n6 1 2 2 2 5 6\n"
                           "7 1 2 2 2 3 6\n",
                       int n_lines = 7, const std::string& height = "0") {
  return "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n" + names +
         "$Nodes\n7\n1 0 0 0\n2 2 0 0\n3 4 0 0\n4 0 1 " + height +
         "\n5 2 1 0\n6 4 1 0\n7 9 9 9\n$EndNodes\n$Elements\n" + std::to_string(4 + n_lines) +
         "\n" + lines +
         "11 2 2 1 1 1 2 5\n12 2 2 1 1 1 5 4\n13 2 2 2 2 2 6 5\n14 2 2 2 2 2 3 6\n$EndElements\n";
}
const std::string version_41 =
    "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n" + names +
    "$Entities\n0 3 2 0\n1 0 0 0 0 1 0 1 1 0\n2 0 0 0 4 1 0 1 2 0\n3 2 0 0 2 1 0 1 3 0\n"
    "1 0 0 0 2 1 0 1 1 0\n2 2 0 0 4 1 0 1 2 0\n$EndEntities\n"
    "$Nodes\n1 7 1 7\n2 1 0 7\n1\n2\n3\n4\n5\n6\n7\n0 0 0\n2 0 0\n4 0 0\n0 1 0\n2 1 0\n4 1 0\n9 9 "
    "9\n"
    "$EndNodes\n$Elements\n5 11 1 14\n1 1 1 1\n1 1 4\n1 2 1 5\n2 1 2\n3 4 5\n5 2 3\n6 5 6\n7 3 6\n"
    "1 3 1 1\n4 2 5\n2 1 2 2\n11 1 2 5\n12 1 5 4\n2 2 2 2\n13 2 6 5\n14 2 3 6\n$EndElements\n";

TEUCHOS_UNIT_TEST(plane_mesh, is_drawn_out_to_a_slab_with_its_names) {
  for (const std::string& content : {version_22(), version_41}) {
    const TemporaryFile file("plane.msh");
    file.fill(content);
    const PlaneMesh plane = read_plane_mesh(file.path);
    TEST_EQUALITY(plane.vertices.size(), 6u);
    const Mesh slab = drawn_out(plane, 0.5, "plane");
    TEST_EQUALITY(slab.tets.size(), 12u);
    TEST_ASSERT(mesh::names(slab.regions) == (std::set<std::string>{"fluid", "beam"}));
    TEST_ASSERT(mesh::names(slab.surfaces) ==
                (std::set<std::string>{"inlet", "walls", "between", "front", "back"}));
    double volume_of_beam = 0.0;
    for (int t = 0; t < 12; ++t)
      if (slab.regions[slab.tet_region[t]].name == "beam") volume_of_beam += volume(slab, t);
    TEST_FLOATING_EQUALITY(volume_of_beam, 1.0, 1e-14);
    std::map<std::string, double> areas;
    for (std::size_t i = 0; i < slab.triangles.size(); ++i)
      areas[slab.surfaces[slab.triangle_surface[i]].name] += area(slab, slab.triangles[i]);
    const std::map<std::string, double> expected{
        {"front", 4.0}, {"back", 4.0}, {"inlet", 0.5}, {"between", 0.5}, {"walls", 4.5}};
    for (const auto& [name, value] : expected) TEST_FLOATING_EQUALITY(areas[name], value, 1e-14);
    TEST_NOTHROW(check_interface(slab, {"fluid"}, {"beam"}, {"between"}));
  }
}

TEUCHOS_UNIT_TEST(plane_mesh, has_a_thickness_of_its_edges) {
  const TemporaryFile file("plane.msh");
  file.fill(version_22());
  // Each triangle has sides of 1, 2 and √5.
  TEST_FLOATING_EQUALITY(mean_edge(read_plane_mesh(file.path)), (3.0 + std::sqrt(5.0)) / 3.0,
                         1e-14);
}

TEUCHOS_UNIT_TEST(plane_mesh, says_what_is_missing) {
  const auto fails = [&](const std::string& content, double thickness, const std::string& part) {
    const TemporaryFile file("plane.msh");
    file.fill(content);
    return fails_with(part, out,
                      [&] { drawn_out(read_plane_mesh(file.path), thickness, file.path); });
  };
  TEST_ASSERT(fails(version_22("1 1 2 1 1 1 4\n", 1), 0.5, "belongs to no curve"));
  TEST_ASSERT(fails(version_22("", 0), 0.5, "bounds the mesh"));
  TEST_ASSERT(fails(version_22(), -1.0, "expected a positive length"));
  TEST_ASSERT(fails(version_22("1 1 2 1 1 1 4\n", 1, "0.3"), 0.5, "expected a plane"));
}

}  // namespace
