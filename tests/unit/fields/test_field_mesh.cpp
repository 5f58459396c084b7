#include <Teuchos_UnitTestHarness.hpp>
#include <algorithm>
#include <set>

#include "tunica/assembly/gather.hpp"
#include "tunica/base/error.hpp"
#include "tunica/base/trilinos.hpp"
#include "tunica/kernels/surface_tri3.hpp"
#include "unit/fields/small_tube.hpp"

namespace {

using namespace tunica;
using fields::FieldMesh;
using test::SmallTube;
using test::world;

/// Per tetrahedron of the whole mesh: how many ranks count it.
std::vector<double> counted(const SmallTube& tube, const FieldMesh& field) {
  std::vector<double> mine(tube.mesh.tets.size(), 0.0), all(mine.size());
  for (std::size_t e = 0; e < field.tets.size(); ++e)
    if (field.is_owned[e]) mine[field.tet_number[e] - 1] += 1.0;
  Teuchos::reduceAll(*world(), Teuchos::REDUCE_SUM, static_cast<int>(mine.size()), mine.data(),
                     all.data());
  return all;
}

TEUCHOS_UNIT_TEST(field_mesh, every_tetrahedron_is_counted_once_in_its_field) {
  const SmallTube tube;
  const auto fluid = counted(tube, tube.fluid), wall = counted(tube, tube.wall);
  for (std::size_t e = 0; e < fluid.size(); ++e) {
    const bool is_fluid = tube.mesh.tet_region[e] == 0;
    TEST_EQUALITY(fluid[e], is_fluid ? 1.0 : 0.0);
    TEST_EQUALITY(wall[e], is_fluid ? 0.0 : 1.0);
  }
}

TEUCHOS_UNIT_TEST(field_mesh, local_tetrahedra_keep_vertices_region_and_number) {
  const SmallTube tube;
  for (std::size_t e = 0; e < tube.wall.tets.size(); ++e) {
    const int number = tube.wall.tet_number[e] - 1;
    for (int a = 0; a < 4; ++a)
      TEST_EQUALITY(tube.wall.vertex[tube.wall.tets[e][a]], tube.mesh.tets[number][a]);
    TEST_EQUALITY(tube.wall.region[e], tube.mesh.tet_region[number]);
  }
  for (int a = 0; a < tube.wall.n_nodes(); ++a)
    TEST_ASSERT(tube.wall.x[a] == tube.mesh.vertices[tube.wall.vertex[a]]);
}

TEUCHOS_UNIT_TEST(field_mesh, an_owned_node_has_all_its_tetrahedra) {
  const SmallTube tube;
  std::vector<int> expected(tube.mesh.vertices.size(), 0), found(expected);
  for (std::size_t e = 0; e < tube.mesh.tets.size(); ++e)
    if (tube.mesh.tet_region[e] != 0)
      for (const int v : tube.mesh.tets[e]) ++expected[v];
  for (const auto& tet : tube.wall.tets)
    for (const int a : tet) ++found[tube.wall.vertex[a]];
  for (int a = 0; a < tube.wall.n_owned; ++a)
    TEST_EQUALITY(found[tube.wall.vertex[a]], expected[tube.wall.vertex[a]]);
}

TEUCHOS_UNIT_TEST(field_mesh, every_rank_owns_nodes_and_together_they_own_all) {
  const SmallTube tube;
  std::set<int> vertices;
  for (std::size_t e = 0; e < tube.mesh.tets.size(); ++e)
    if (tube.mesh.tet_region[e] == 0)
      vertices.insert(tube.mesh.tets[e].begin(), tube.mesh.tets[e].end());
  TEST_ASSERT(tube.fluid.n_owned > 0);
  TEST_EQUALITY(global_sum(*world(), 1.0 * tube.fluid.n_owned),
                static_cast<double>(vertices.size()));
}

TEUCHOS_UNIT_TEST(field_mesh, maps_are_contiguous_and_three_dofs_follow_their_node) {
  const SmallTube tube;
  for (const FieldMesh* field : {&tube.fluid, &tube.wall}) {
    TEST_ASSERT(field->node_map->isContiguous());
    TEST_ASSERT(field->vector_map->isContiguous());
    TEST_EQUALITY(field->node_map->getMinAllGlobalIndex(), 0);
    TEST_EQUALITY(static_cast<int>(n_local(*field->node_map)), field->n_owned);
    TEST_EQUALITY(static_cast<int>(n_local(*field->ghosted_map)), field->n_nodes());
    for (int a = 0; a < field->n_nodes(); ++a) {
      const auto node = field->ghosted_map->getGlobalElement(a);
      TEST_EQUALITY(node == field->node_map->getGlobalElement(a), a < field->n_owned);
      for (int i = 0; i < 3; ++i)
        TEST_EQUALITY(field->ghosted_vector_map->getGlobalElement(3 * a + i), 3 * node + i);
    }
  }
}

TEUCHOS_UNIT_TEST(field_mesh, ghosts_receive_the_values_of_their_owners) {
  const SmallTube tube;
  const auto x = test::block_vector(tube.wall, [](int v, int i) { return 10.0 * v + i; });
  const auto u = fields::ghosted_vectors(tube.wall, x[0]);
  const auto p = fields::ghosted_scalars(tube.wall, x[1]);
  TEST_EQUALITY(static_cast<int>(u.size()), tube.wall.n_nodes());
  for (int a = 0; a < tube.wall.n_nodes(); ++a) {
    const double v = 10.0 * tube.wall.vertex[a];
    TEST_ASSERT(u[a] == (Vec3{v, v + 1, v + 2}));
    TEST_EQUALITY(p[a], v + 3);
  }
  Vector stored(tube.wall.vector_map);
  fields::store(u, tube.wall, stored);
  stored.update(-1.0, x[0], 1.0);
  TEST_EQUALITY(stored.normInf(), 0.0);
}

TEUCHOS_UNIT_TEST(field_mesh, faces_close_the_field_and_point_outward) {
  const SmallTube tube;
  for (const FieldMesh* field : {&tube.fluid, &tube.wall}) {
    Vec3 closure{};
    double flux = 0.0, volume = 0.0;  // ∫ x·n dA = 3 V
    for (const fields::Face& face : field->faces) {
      if (!face.is_owned) continue;
      const auto x = assembly::gather(field->x, face.nodes);
      const Vec3 n = kernels::area_normal(x);
      closure += n;
      flux += dot(n, x[0] + x[1] + x[2]) / 3.0;
    }
    for (std::size_t e = 0; e < field->tets.size(); ++e) {
      const auto x = assembly::gather(field->x, field->tets[e]);
      if (field->is_owned[e]) volume += signed_volume(x[0], x[1], x[2], x[3]);
    }
    for (int i = 0; i < 3; ++i) TEST_COMPARE(std::abs(global_sum(*world(), closure[i])), <, 1e-12);
    volume = global_sum(*world(), volume);
    TEST_ASSERT(volume > 0.0);
    TEST_FLOATING_EQUALITY(global_sum(*world(), flux), 3.0 * volume, 1e-12);
  }
}

TEUCHOS_UNIT_TEST(field_mesh, surfaces_of_the_other_field_and_layers_are_no_boundary) {
  const SmallTube tube;
  const int layer = tube.surface("layer"), outer = tube.surface("outer");
  double faces_of_layer = 0.0, fluid_on_outer = 0.0, wall_on_outer = 0.0;
  for (const auto& face : tube.wall.faces) faces_of_layer += face.surface == layer;
  for (int a = 0; a < tube.fluid.n_owned; ++a) fluid_on_outer += tube.fluid.is_on(a, outer);
  for (int a = 0; a < tube.wall.n_owned; ++a) wall_on_outer += tube.wall.is_on(a, outer);
  TEST_EQUALITY(global_sum(*world(), faces_of_layer), 0.0);
  TEST_EQUALITY(global_sum(*world(), fluid_on_outer), 0.0);
  TEST_EQUALITY(global_sum(*world(), wall_on_outer), 8.0 * 4.0);  // 8 around, 4 along
}

TEUCHOS_UNIT_TEST(field_mesh, nodes_know_their_surfaces_on_every_rank) {
  const SmallTube tube;
  const int inlet = tube.surface("inlet"), interface = tube.surface("interface");
  for (int a = 0; a < tube.fluid.n_nodes(); ++a) {  // ghosts too
    const Vec3& x = tube.fluid.x[a];
    TEST_EQUALITY(tube.fluid.is_on(a, inlet), std::abs(x[2]) < 1e-12);
    TEST_EQUALITY(tube.fluid.is_on(a, interface), std::hypot(x[0], x[1]) > 1.43 - 1e-9);
  }
}

/// A tube's fluid, each triangle of whose side is a surface of its own.
struct ManySurfaces {
  explicit ManySurfaces(const CommPtr& comm) {
    mesh::Tube shape = SmallTube::options();
    shape.axial = 4;
    const SmallTube tube(comm, shape);
    whole = tube.mesh;
    const int side = tube.surface("interface");
    for (std::size_t t = 0; t < whole.triangles.size(); ++t) {
      if (whole.triangle_surface[t] != side) continue;
      whole.triangle_surface[t] = static_cast<int>(whole.surfaces.size());
      whole.surfaces.push_back({1000 + static_cast<int>(t), "patch-" + std::to_string(t)});
    }
    mesh::validate(whole, "patches");
    field = fields::make_field_mesh(test::share_of(whole, {true, false, false}, comm), {0});
  }
  mesh::Mesh whole;
  FieldMesh field;
};

TEUCHOS_UNIT_TEST(field_mesh, nodes_may_lie_on_any_number_of_surfaces) {
  const ManySurfaces many(world());
  const FieldMesh& field = many.field;
  const int n = static_cast<int>(field.surfaces.size());
  TEST_EQUALITY(n, 7 + 2 * 8 * 4);  // those of a tube, and the triangles of its interface
  std::vector<std::set<int>> expected(many.whole.vertices.size());
  const auto is_fluid = [&](const std::array<int, 3>& t) {
    return std::all_of(t.begin(), t.end(), [&](int v) {
      return std::hypot(many.whole.vertices[v][0], many.whole.vertices[v][1]) < 1.43 + 1e-9;
    });
  };
  for (std::size_t t = 0; t < many.whole.triangles.size(); ++t)
    if (is_fluid(many.whole.triangles[t]))
      for (const int v : many.whole.triangles[t])
        expected[v].insert(many.whole.triangle_surface[t]);
  for (int a = 0; a < field.n_nodes(); ++a) {
    const std::set<int>& on = expected[field.vertex[a]];
    for (int s = 0; s < n; ++s) TEST_EQUALITY(field.is_on(a, s), on.count(s) == 1);
    TEST_EQUALITY(field.is_on_boundary(a), !on.empty());
  }
}

}  // namespace
