#include <Teuchos_DefaultSerialComm.hpp>
#include <Teuchos_UnitTestHarness.hpp>
#include <cmath>

#include "helpers.hpp"
#include "tunica/mesh/distributed/refine.hpp"
#include "tunica/mesh/faces.hpp"
#include "tunica/mesh/info.hpp"
#include "tunica/mesh/read.hpp"
#include "tunica/mesh/validate.hpp"

using namespace tunica::mesh;

namespace {

Mesh refine(const Mesh& mesh, const std::vector<std::string>& project = {}) {
  const tunica::CommPtr alone = Teuchos::rcp(new Teuchos::SerialComm<int>);
  return tunica::mesh::refine(slab_of(mesh, alone), project).rows;
}

TEUCHOS_UNIT_TEST(mesh_refine, counts_multiply_and_volumes_areas_and_names_stay) {
  const Mesh coarse = read(data_folder + "/mesh-tube-small.msh");
  const Mesh fine = refine(coarse);
  TEST_NOTHROW(validate(fine, "fine"));
  TEST_NOTHROW(check_interface(fine, {"fluid"}, {"media", "adventitia"}, {"interface"}));
  const Info a = inspect(coarse), b = inspect(fine);
  TEST_EQUALITY(b.tets, 8 * a.tets);
  TEST_EQUALITY(b.triangles, 4 * a.triangles);
  TEST_EQUALITY(b.vertices, a.vertices + a.edges);
  TEST_EQUALITY(b.euler(), a.euler());
  for (std::size_t r = 0; r < a.regions.size(); ++r) {
    TEST_EQUALITY(b.regions[r].name, a.regions[r].name);
    TEST_FLOATING_EQUALITY(b.regions[r].volume, a.regions[r].volume, 1e-12);
  }
  for (std::size_t s = 0; s < a.surfaces.size(); ++s) {
    TEST_ASSERT(b.surfaces[s].neighbours == a.surfaces[s].neighbours);
    TEST_FLOATING_EQUALITY(b.surfaces[s].area, a.surfaces[s].area, 1e-12);
  }
}

TEUCHOS_UNIT_TEST(mesh_refine, parts_inherit_the_vectors_of_their_tetrahedron) {
  using tunica::operator*, tunica::operator-, tunica::operator+=;
  const Mesh mesh = with_vectors(make_tube(smallest_tube()));
  const Mesh fine = refine(mesh);
  TEST_EQUALITY(fine.tet_vectors.size(), 2u);
  // The centres of the eight parts have the centre of the whole as their mean.
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    double volume_sum = 0.0;
    tunica::Vec3 mean{};
    for (std::size_t part = 8 * t; part < 8 * t + 8; ++part) {
      TEST_ASSERT(fine.tet_vectors[0].values[part] == centroid(mesh, t));
      const double V = volume(fine, static_cast<int>(part));
      volume_sum += V;
      mean += V * centroid(fine, part);
    }
    TEST_COMPARE(tunica::norm(1.0 / volume_sum * mean - centroid(mesh, t)), <, 1e-12);
  }
}

TEUCHOS_UNIT_TEST(mesh_refine, quality_is_bounded_over_repeated_refinement) {
  const Mesh once = refine(make_tube(smallest_tube()));
  const Mesh twice = refine(once);
  TEST_ASSERT(inspect(twice).worst_quality > 0.5 * inspect(once).worst_quality);
}

TEUCHOS_UNIT_TEST(mesh_refine, projection_puts_new_vertices_on_the_cylinder) {
  Tube t;
  t.around = 24;
  const Mesh coarse = make_tube(t);
  const Mesh fine = refine(coarse, {"interface", "layer", "outer"});
  TEST_NOTHROW(validate(fine, "fine"));
  const int interface = surface_index(fine, "interface");
  for (std::size_t i = 0; i < fine.triangles.size(); ++i) {
    if (fine.triangle_surface[i] != interface) continue;
    for (const int v : fine.triangles[i])
      TEST_FLOATING_EQUALITY(std::hypot(fine.vertices[v][0], fine.vertices[v][1]), t.radius, 1e-12);
  }
  TEST_ASSERT(inspect(fine).regions[0].volume > 1.001 * inspect(coarse).regions[0].volume);
}

TEUCHOS_UNIT_TEST(mesh_refine, projection_that_inverts_is_refused) {
  const Mesh coarse = read(data_folder + "/mesh-tube-small.msh");
  TEST_ASSERT(fails_with("inverts", out, [&] { refine(coarse, {"interface", "layer"}); }));
}

TEUCHOS_UNIT_TEST(mesh_refine, projection_of_a_plane_is_refused) {
  const Mesh coarse = make_tube(Tube());
  TEST_ASSERT(fails_with("no cylinder", out, [&] { refine(coarse, {"inlet"}); }));
  TEST_ASSERT(fails_with("Did you mean \"outer\"", out, [&] { refine(coarse, {"outr"}); }));
}

}  // namespace
