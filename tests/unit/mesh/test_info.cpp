#include <Teuchos_UnitTestHarness.hpp>
#include <cmath>

#include "helpers.hpp"
#include "tunica/mesh/info.hpp"

using namespace tunica::mesh;

namespace {

/// Tetrahedron with unit edges along the axes.
Mesh unit_tet() {
  Mesh m;
  m.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  m.tets = {{0, 1, 2, 3}};
  m.tet_region = {0};
  m.regions = {{1, "fluid"}};
  m.surfaces = {{4, "skin"}};
  m.triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  m.triangle_surface = {0, 0, 0, 0};
  return m;
}

TEUCHOS_UNIT_TEST(mesh_info, numbers_of_one_tetrahedron_are_right) {
  const Info info = inspect(unit_tet());
  TEST_EQUALITY(info.edges, 6);
  TEST_EQUALITY(info.faces, 4);
  TEST_EQUALITY(info.euler(), 1);
  TEST_FLOATING_EQUALITY(info.regions[0].volume, 1.0 / 6.0, 1e-15);
  TEST_FLOATING_EQUALITY(info.surfaces[0].area, 1.5 + 0.5 * std::sqrt(3.0), 1e-15);
  TEST_FLOATING_EQUALITY(info.shortest_edge, 1.0, 1e-15);
  TEST_FLOATING_EQUALITY(info.longest_edge, std::sqrt(2.0), 1e-15);
  TEST_FLOATING_EQUALITY(info.worst_quality, 12.0 * std::cbrt(0.25) / 9.0, 1e-14);
  TEST_ASSERT(to_text(info).find("fluid") != std::string::npos);
}

TEUCHOS_UNIT_TEST(mesh_info, regular_tetrahedron_has_quality_one) {
  Mesh m = unit_tet();
  m.vertices = {{1, 1, 1}, {-1, 1, -1}, {1, -1, -1}, {-1, -1, 1}};
  TEST_FLOATING_EQUALITY(std::abs(quality(m, 0)), 1.0, 1e-14);
}

TEUCHOS_UNIT_TEST(mesh_info, separate_pieces_and_twin_vertices_are_counted) {
  Mesh m = unit_tet();
  m.vertices.insert(m.vertices.end(), {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, -1}});
  m.tets.push_back({4, 6, 5, 7});
  m.tet_region.push_back(0);
  const Info info = inspect(m);
  TEST_EQUALITY(info.pieces, 2);
  TEST_EQUALITY(info.twin_vertices, 3);
  TEST_ASSERT(to_text(info).find("NOT CONFORMING") != std::string::npos);
}

TEUCHOS_UNIT_TEST(mesh_info, contacts_count_faces_between_regions) {
  const Info info = inspect(make_tube(smallest_tube()));
  TEST_EQUALITY(info.contacts.size(), 2u);
  TEST_EQUALITY(info.contacts[0].faces, 8);
  TEST_EQUALITY(info.contacts[0].tagged_faces, 8);
}

}  // namespace
