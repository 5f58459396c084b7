#include <Teuchos_UnitTestHarness.hpp>
#include <array>
#include <map>

#include "helpers.hpp"
#include "tunica/mesh/partition.hpp"
#include "tunica/mesh/read.hpp"

using namespace tunica::mesh;

namespace {

const std::vector<bool> first_is_fluid{true, false, false};

/// Per part: tetrahedra of fluid and of wall.
std::vector<std::array<int, 2>> work(const Mesh& mesh, const Partition& p, int parts) {
  std::vector<std::array<int, 2>> result(parts);
  for (std::size_t t = 0; t < mesh.tets.size(); ++t)
    ++result[p.tet_part[t]][mesh.tet_region[t] == 0 ? 0 : 1];
  return result;
}

/// Per part: owned vertices of fluid and of wall.
std::vector<std::array<int, 2>> owned(const Mesh& mesh, const Partition& p, int parts) {
  std::vector<std::array<bool, 2>> is_in(mesh.vertices.size());
  for (std::size_t t = 0; t < mesh.tets.size(); ++t)
    for (const int v : mesh.tets[t]) is_in[v][mesh.tet_region[t] == 0 ? 0 : 1] = true;
  std::vector<std::array<int, 2>> result(parts);
  for (std::size_t v = 0; v < is_in.size(); ++v)
    for (const int field : {0, 1}) result[p.vertex_owner[v]][field] += is_in[v][field];
  return result;
}

TEUCHOS_UNIT_TEST(mesh_partition, both_fields_are_balanced) {
  const Mesh mesh = make_tube(Tube());
  const double fluid = 972.0, wall = 3888.0;
  for (const int parts : {2, 3, 4, 8}) {
    const auto result = work(mesh, partition(mesh, parts, first_is_fluid), parts);
    for (const auto& [f, w] : result) {
      TEST_COMPARE(f, <, 1.1 * fluid / parts);
      TEST_COMPARE(w, <, 1.1 * wall / parts);
    }
  }
}

TEUCHOS_UNIT_TEST(mesh_partition, same_input_gives_same_parts) {
  const Mesh mesh = make_tube(Tube());
  const Partition a = partition(mesh, 5, first_is_fluid), b = partition(mesh, 5, first_is_fluid);
  TEST_ASSERT(a.tet_part == b.tet_part);
  TEST_ASSERT(a.vertex_owner == b.vertex_owner);
}

TEUCHOS_UNIT_TEST(mesh_partition, owner_holds_most_of_the_vertex) {
  const Mesh mesh = read(data_folder + "/mesh-tube-small.msh");
  const Partition p = partition(mesh, 4, first_is_fluid);
  std::vector<std::map<int, int>> count(mesh.vertices.size());
  for (std::size_t t = 0; t < mesh.tets.size(); ++t)
    for (const int v : mesh.tets[t]) ++count[v][p.tet_part[t]];
  for (std::size_t v = 0; v < count.size(); ++v)
    for (const auto& [part, tets] : count[v]) {
      TEST_ASSERT(tets <= count[v][p.vertex_owner[v]]);
      TEST_ASSERT(tets < count[v][p.vertex_owner[v]] || part >= p.vertex_owner[v]);
    }
}

TEUCHOS_UNIT_TEST(mesh_partition, every_part_owns_vertices_of_both_fields) {
  const Mesh mesh = read(data_folder + "/mesh-tube-small.msh");
  for (const int parts : {2, 7, 16, 40})
    for (const auto& [fluid, wall] : owned(mesh, partition(mesh, parts, first_is_fluid), parts)) {
      TEST_COMPARE(fluid, >=, 1);
      TEST_COMPARE(wall, >=, 1);
    }
}

TEUCHOS_UNIT_TEST(mesh_partition, one_field_alone_can_be_split) {
  Tube t;
  t.with_lumen = false;
  const Mesh wall = make_tube(t);
  const Partition p = partition(wall, 3, {false, false});
  for (int part = 0; part < 3; ++part) {
    const auto tets = std::count(p.tet_part.begin(), p.tet_part.end(), part);
    TEST_COMPARE(tets, <, 1.1 * wall.tets.size() / 3);
    TEST_ASSERT(std::count(p.vertex_owner.begin(), p.vertex_owner.end(), part) > 0);
  }
}

TEUCHOS_UNIT_TEST(mesh_partition, one_part_holds_everything) {
  const Mesh mesh = make_tube(smallest_tube());
  const Partition p = partition(mesh, 1, first_is_fluid);
  TEST_ASSERT(p.tet_part == std::vector<int>(mesh.tets.size(), 0));
  TEST_ASSERT(p.vertex_owner == std::vector<int>(mesh.vertices.size(), 0));
}

TEUCHOS_UNIT_TEST(mesh_partition, every_part_has_an_element_up_to_as_many_parts_as_elements) {
  const Mesh mesh = make_tube(smallest_tube());
  const int n = static_cast<int>(mesh.tets.size());
  for (const int parts : {2, 5, 11, n / 2, n - 1, n}) {
    const Partition p = partition(mesh, parts, first_is_fluid);
    for (int part = 0; part < parts; ++part)
      TEST_ASSERT(std::count(p.tet_part.begin(), p.tet_part.end(), part) > 0);
    for (std::size_t v = 0; v < mesh.vertices.size(); ++v)
      TEST_ASSERT(p.vertex_owner[v] >= 0 && p.vertex_owner[v] < parts);
  }
}

TEUCHOS_UNIT_TEST(mesh_partition, more_parts_than_elements_are_refused) {
  const Mesh mesh = make_tube(smallest_tube());
  const int n = static_cast<int>(mesh.tets.size());
  TEST_ASSERT(fails_with("more ranks than elements: " + std::to_string(n + 1), out,
                         [&] { partition(mesh, n + 1, first_is_fluid); }));
  TEST_ASSERT(fails_with("expected 1 or more", out, [&] { partition(mesh, 0, first_is_fluid); }));
  TEST_ASSERT(fails_with("one per region", out, [&] { partition(mesh, 2, {true}); }));
}

}  // namespace
