#include <Teuchos_UnitTestHarness.hpp>

#include "helpers.hpp"
#include "tunica/mesh/info.hpp"
#include "tunica/mesh/read.hpp"
#include "tunica/mesh/validate.hpp"

using namespace tunica::mesh;

namespace {

const std::string folder = TUNICA_MESHES;

TEUCHOS_UNIT_TEST(mesh_shipped, tiny_is_what_its_script_makes) {
  const Mesh mesh = read(folder + "/tube-tiny.h5");
  Tube t;
  t.around = 12;
  t.axial = 18;
  TEST_ASSERT(mesh.tets == make_tube(t).tets);
  TEST_EQUALITY(mesh.vertices.size(), 988u);
  TEST_NOTHROW(check_interface(mesh, {"fluid"}, {"media", "adventitia"}, {"interface"}));
}

TEUCHOS_UNIT_TEST(mesh_shipped, coarse_is_what_its_script_makes) {
  const Mesh mesh = read(folder + "/tube-coarse.h5");
  Tube t;
  t.around = 20;
  t.axial = 62;
  t.media_layers = 3;
  TEST_ASSERT(mesh.tets == make_tube(t).tets);
  const Info info = inspect(mesh);
  TEST_EQUALITY(info.regions[0].tets, 9300);
  TEST_EQUALITY(info.regions[0].vertices, 2268);
  TEST_COMPARE(info.worst_quality, >, 0.29);
  TEST_NOTHROW(check_interface(mesh, {"fluid"}, {"media", "adventitia"}, {"interface"}));
}

TEUCHOS_UNIT_TEST(mesh_shipped, grown_walls_conform) {
  for (const std::string name : {"bend", "bulge", "bifurcation"}) {
    const Mesh mesh = read(folder + "/" + name + ".h5");
    TEST_NOTHROW(check_interface(mesh, {"fluid"}, {"media", "adventitia"}, {"interface"}));
    TEST_NOTHROW(surface_index(mesh, "wall_inlet"));
    const Info info = inspect(mesh);
    TEST_EQUALITY(info.pieces, 1);
    TEST_COMPARE(info.worst_quality, >, 0.15);
    TEST_COMPARE(info.tets, <, 15000);
  }
}

}  // namespace
