#include <Teuchos_UnitTestHarness.hpp>
#include <functional>

#include "helpers.hpp"
#include "tunica/base/portion.hpp"
#include "tunica/mesh/distributed/text_mesh.hpp"
#include "tunica/mesh/formats/gmsh.hpp"
#include "tunica/mesh/read.hpp"
#include "world.hpp"

using namespace tunica;
using namespace tunica::mesh;

namespace {

/// A file that rank 0 writes and all read.
class SharedText {
public:
  SharedText(const std::string& name, const std::function<void(const std::string&)>& fill)
      : path("np" + std::to_string(world()->getSize()) + "_" + name) {
    if (world()->getRank() == 0) fill(path);
    world()->barrier();
  }
  ~SharedText() {
    world()->barrier();
    if (world()->getRank() == 0) std::filesystem::remove(path);
  }
  const std::string path;
};

TEUCHOS_UNIT_TEST(text_mesh, in_pieces_is_that_which_one_rank_reads) {
  Tube shape;
  shape.axial = 12;
  Mesh mesh = with_vectors(make_tube(shape));
  for (Tag& tag : mesh.surfaces)  // untagged on the boundary, which stay, and inside, which go
    if (tag.name == "layer" || tag.name == "inlet") tag.id = tag.name == "layer" ? 0 : 50;
  for (auto& tet : mesh.tets) std::swap(tet[0], tet[1]);             // all negative
  mesh.vertices.insert(mesh.vertices.begin() + 5, {9.0, 9.0, 9.0});  // of no element
  const auto move = [](auto& elements) {
    for (auto& element : elements)
      for (int& v : element) v += v >= 5;
  };
  move(mesh.tets);
  move(mesh.triangles);
  for (const GmshVersion version : {GmshVersion::v22, GmshVersion::v41}) {
    const SharedText file("tube.msh",
                          [&](const std::string& path) { write_gmsh(mesh, path, version); });
    const Mesh alone = read(file.path);
    TEST_EQUALITY(alone.vertices.size() + 1, mesh.vertices.size());
    TEST_COMPARE(alone.triangles.size(), <, mesh.triangles.size());
    TEST_EQUALITY(alone.tet_vectors.size(), 2u);
    for (const int rows_at_once : {7, 100, RowStream::piece}) {
      const Slab slab = read_text_mesh(file.path, world(), rows_at_once);
      TEST_EQUALITY(portion_of(slab.tets, *world()).count,
                    static_cast<long long>(slab.rows.tets.size()));
      const Mesh whole = gathered(slab);
      if (world()->getRank() == 0) TEST_ASSERT(are_identical(whole, alone));
    }
  }
}

TEUCHOS_UNIT_TEST(text_mesh, of_netgen_is_that_of_gmsh) {
  const Slab gmsh = read_text_mesh(data_folder + "/mesh-tube-small.msh", world(), 50);
  const Slab netgen = read_text_mesh(data_folder + "/mesh-tube-small.vol", world(), 50);
  TEST_ASSERT(gmsh.rows.vertices == netgen.rows.vertices);
  TEST_ASSERT(gmsh.rows.tet_region == netgen.rows.tet_region);
  TEST_ASSERT(gmsh.rows.triangles == netgen.rows.triangles);
  TEST_ASSERT(gmsh.rows.triangle_surface == netgen.rows.triangle_surface);
}

TEUCHOS_UNIT_TEST(text_mesh, faults_of_the_file_are_told_on_all_ranks) {
  const auto refuses = [&](const std::string& part, const std::string& name,
                           const std::string& before, const std::string& after) {
    const SharedText file("bad_" + name, [&](const std::string& path) {
      std::string text = read_text(data_folder + "/" + name);
      text.replace(text.find(before), before.size(), after);
      std::ofstream(path) << text;
    });
    return fails_with(part, out, [&] { read_text_mesh(file.path, world(), 20); });
  };
  const std::string last = "4261 4 2 3 3 24 43 422 44";
  TEST_ASSERT(refuses("inverted element: element 4261 of region \"adventitia\"",
                      "mesh-tube-small.msh", last, "4261 4 2 3 3 24 43 44 422"));
  TEST_ASSERT(refuses("node 4220 is not in $Nodes", "mesh-tube-small.msh", last,
                      "4261 4 2 3 3 24 43 4220 44"));
  TEST_ASSERT(refuses("Is it truncated?", "mesh-tube-small.msh", "$EndElements", ""));
  TEST_ASSERT(refuses("volume element 1 has point 9599, but the file has 647 points",
                      "mesh-tube-small.vol", "1 4 60 61 245 599", "1 4 60 61 245 9599"));
  TEST_ASSERT(refuses("the file has no tetrahedra", "mesh-tube-small.vol", "volumeelements\n3031",
                      "volumeelements\n0\nnothing\n3031"));
}

}  // namespace
