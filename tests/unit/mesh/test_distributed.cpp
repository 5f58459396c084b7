#include <Teuchos_DefaultSerialComm.hpp>
#include <Teuchos_UnitTestHarness.hpp>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "helpers.hpp"
#include "tunica/base/agreement.hpp"
#include "tunica/base/reduce.hpp"
#include "tunica/mesh/distributed/refine.hpp"
#include "tunica/mesh/distributed/rows.hpp"
#include "tunica/mesh/distributed/share.hpp"
#include "tunica/mesh/formats/hdf5.hpp"
#include "tunica/mesh/validate.hpp"
#include "tunica/mesh/write.hpp"
#include "world.hpp"

using namespace tunica;
using namespace tunica::mesh;

namespace {

const std::vector<bool> tube_fluid{true, false, false};

CommPtr alone() { return Teuchos::rcp(new Teuchos::SerialComm<int>); }

Mesh tube() {
  Tube shape;
  shape.around = 12;
  shape.axial = 12;
  return with_vectors(make_tube(shape));
}

SlabPartition partitioned(const Slab& slab, Partitioner by = Partitioner::geometric) {
  return partition(slab, tube_fluid, vertex_fields(slab, tube_fluid, "mesh"), by, "mesh");
}

Share share_of(const Mesh& whole, Partitioner by) {
  return mesh::share_of(slab_of(whole, world()), tube_fluid, by, "tube");
}

/// What a file has, on all ranks: written by one.
struct WrittenTube {
  WrittenTube() : mesh(tube()) {
    if (world()->getRank() == 0) write(mesh, path);
    world()->barrier();
  }
  ~WrittenTube() {
    world()->barrier();
    if (world()->getRank() == 0) std::filesystem::remove(path);
  }
  Mesh mesh;
  std::string path = "distributed_np" + std::to_string(world()->getSize()) + ".h5";
};

TEUCHOS_UNIT_TEST(exchange, every_rank_gets_what_others_send_in_the_order_of_the_ranks) {
  const int me = world()->getRank(), n = world()->getSize();
  std::vector<int> items, ranks;  // 10 me + k to rank k, twice to rank 0
  for (int k = 0; k < n; ++k) {
    items.push_back(10 * me + k);
    ranks.push_back(k);
  }
  items.push_back(1000 + me);
  ranks.push_back(0);
  const Received<int> got = exchange_to(*world(), items, ranks);
  std::vector<int> expected;
  for (int r = 0; r < n; ++r) {
    expected.push_back(10 * r + me);
    if (me == 0) expected.push_back(1000 + r);
  }
  TEST_COMPARE_ARRAYS(got.items, expected);
  TEST_COMPARE_ARRAYS(got.counts, std::vector<int>(n, me == 0 ? 2 : 1));
}

TEUCHOS_UNIT_TEST(slab, ranks_read_their_rows_of_a_file_and_together_all) {
  const WrittenTube tube;
  const Slab slab = read_slab(tube.path, world());
  const Mesh whole = gathered(slab);
  if (world()->getRank() == 0) TEST_ASSERT(are_identical(whole, tube.mesh));
  const double most = std::ceil(static_cast<double>(slab.tets) / world()->getSize());
  TEST_COMPARE(static_cast<double>(slab.rows.tets.size()), <=, most);
}

TEUCHOS_UNIT_TEST(slab, of_a_mesh_on_one_rank_is_that_of_its_file) {
  const WrittenTube tube;
  const Slab read = read_slab(tube.path, world());
  const Slab given = slab_of(world()->getRank() == 0 ? tube.mesh : Mesh{}, world());
  TEST_ASSERT(are_identical(read.rows, given.rows));
  TEST_EQUALITY(fingerprint(read), fingerprint(given));
}

TEUCHOS_UNIT_TEST(slab, ranks_write_together_what_one_reads) {
  const WrittenTube tube;
  const std::string path = "written_" + tube.path;
  write_slab(read_slab(tube.path, world()), path);
  if (world()->getRank() == 0) {
    TEST_ASSERT(are_identical(read_hdf5(path), tube.mesh));
    TEST_ASSERT(!std::filesystem::exists(path + ".tmp"));
    std::filesystem::remove(path);
  }
  world()->barrier();
}

TEUCHOS_UNIT_TEST(slab, fingerprint_is_that_of_the_mesh_whatever_the_ranks) {
  const Mesh mesh = tube();
  const std::string print = fingerprint(slab_of(mesh, world()));
  TEST_EQUALITY(print, fingerprint(slab_of(mesh, alone())));
  TEST_EQUALITY(print.size(), 16u);
  const auto changes = [&](const auto& change) {
    Mesh other = mesh;
    change(other);
    return fingerprint(slab_of(other, world())) != print;
  };
  // A case would mean another surface by its name.
  TEST_ASSERT(changes([](Mesh& m) { std::swap(m.surfaces[0].name, m.surfaces[1].name); }));
  TEST_ASSERT(changes([](Mesh& m) { m.regions.front().name = "another"; }));
  TEST_ASSERT(!changes([](Mesh& m) { m.surfaces.front().id += 1000; }));
  TEST_ASSERT(
      changes([](Mesh& m) { m.vertices.back()[2] = std::nextafter(m.vertices.back()[2], 1e9); }));
  TEST_ASSERT(changes([](Mesh& m) { std::swap(m.tets[0], m.tets[1]); }));
  TEST_ASSERT(changes([](Mesh& m) { m.tet_vectors[1].values.back()[0] += 1.0; }));
  TEST_ASSERT(changes([](Mesh& m) { m.tet_vectors[1].name = "another"; }));
}

TEUCHOS_UNIT_TEST(slab, extent_is_that_of_the_box) {
  Mesh mesh = tube();
  for (Vec3& x : mesh.vertices) x[0] += 10.0;
  double low = 1e300, high = -1e300;
  for (const Vec3& x : mesh.vertices) {
    low = std::min(low, x[0]);
    high = std::max(high, x[0]);
  }
  const Vec3 lengths = extent(slab_of(mesh, world()));
  TEST_FLOATING_EQUALITY(lengths[0], high - low, 1e-12);
  TEST_FLOATING_EQUALITY(lengths[2], 18.0, 1e-12);
}

TEUCHOS_UNIT_TEST(slab, is_refined_as_on_one_rank) {
  const Mesh mesh = tube();
  const std::vector<std::string> round{"interface", "layer", "outer"};
  const Slab fine = refine(refine(slab_of(mesh, world()), round));
  const Slab expected = refine(refine(slab_of(mesh, alone()), round));
  TEST_EQUALITY(fine.tets, 64 * static_cast<long long>(mesh.tets.size()));
  const Mesh whole = gathered(fine);
  if (world()->getRank() == 0) TEST_ASSERT(are_identical(whole, expected.rows));
}

TEUCHOS_UNIT_TEST(partition_slab, planes_give_every_rank_its_part_of_both_fields) {
  const Slab slab = slab_of(tube(), world());
  const auto fields = vertex_fields(slab, tube_fluid, "mesh");
  const SlabPartition parts = partition(slab, tube_fluid, fields, Partitioner::geometric, "mesh");
  const Balance found = balance(slab, fields, parts);
  TEST_COMPARE(found.fluid, <, 1.15);
  TEST_COMPARE(found.wall, <, 1.05);
  if (world()->getSize() > 1) TEST_COMPARE(found.cut, <, 0.05 + 0.1 * world()->getSize());
  if (world()->getSize() == 1) TEST_EQUALITY(found.cut, 0.0);
}

TEUCHOS_UNIT_TEST(partition_slab, a_small_wall_in_a_large_fluid_is_shared_by_all_ranks) {
  Mesh mesh = tube();  // of the wall only what is below z = 1.5 remains wall
  for (std::size_t t = 0; t < mesh.tets.size(); ++t)
    if (centroid(mesh, t)[2] > 1.5) mesh.tet_region[t] = 0;
  const Slab slab = slab_of(mesh, world());
  const auto fields = vertex_fields(slab, tube_fluid, "mesh");
  const SlabPartition parts = partition(slab, tube_fluid, fields, Partitioner::geometric, "mesh");
  const Balance found = balance(slab, fields, parts);
  TEST_COMPARE(found.fluid, <, 1.1);
  TEST_COMPARE(found.wall, <, 1.1);
}

TEUCHOS_UNIT_TEST(partition_slab, more_ranks_than_tetrahedra_are_refused) {
  Mesh one;
  one.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  one.tets = {{0, 1, 2, 3}};
  one.tet_region = {0};
  one.regions = {{1, "a"}};
  const Slab slab = slab_of(one, world());
  if (world()->getSize() == 1) {
    TEST_NOTHROW(partitioned(slab));
  } else {
    TEST_ASSERT(fails_with("mesh: more ranks than elements", out, [&] { partitioned(slab); }));
  }
}

TEUCHOS_UNIT_TEST(partitioner, names_are_those_of_case_files) {
  for (const std::string& name : partitioner_names()) TEST_NOTHROW(partitioner_of(name));
  TEST_ASSERT(partitioner_of("geometric") == Partitioner::geometric);
  TEST_ASSERT(fails_with("Did you mean \"metis\"?", out, [] { partitioner_of("mettis"); }));
}

/// What must hold of a share of the tube, however it is cut.
void check_share(const Mesh& whole, const Share& share, Teuchos::FancyOStream& out, bool& success) {
  const auto& vertex = share.numbers.vertices;
  std::vector<double> counted(whole.tets.size(), 0.0), owned(whole.vertices.size(), 0.0);
  std::vector<int> around(whole.vertices.size(), 0), expected(around);
  for (const auto& tet : whole.tets)
    for (const int v : tet) ++expected[v];
  for (std::size_t t = 0; t < share.mesh.tets.size(); ++t) {
    const auto number = static_cast<std::size_t>(share.numbers.tets[t]);
    for (int i = 0; i < 4; ++i) {
      TEST_EQUALITY(vertex[share.mesh.tets[t][i]], whole.tets[number][i]);
      ++around[vertex[share.mesh.tets[t][i]]];
    }
    TEST_EQUALITY(share.mesh.tet_region[t], whole.tet_region[number]);
    TEST_ASSERT(share.mesh.tet_vectors[1].values[t] == whole.tet_vectors[1].values[number]);
    counted[number] += share.counts(t);
    if (t > 0) TEST_ASSERT(share.numbers.tets[t - 1] < share.numbers.tets[t]);
  }
  for (std::size_t v = 0; v < vertex.size(); ++v) {
    TEST_ASSERT(share.mesh.vertices[v] == whole.vertices[vertex[v]]);
    if (v > 0) TEST_ASSERT(vertex[v - 1] < vertex[v]);
    if (!share.is_owned[v]) continue;
    TEST_EQUALITY(around[vertex[v]], expected[vertex[v]]);
    owned[vertex[v]] += 1.0;
  }
  for (const double n : global_sum(*world(), counted)) TEST_EQUALITY(n, 1.0);
  for (const double n : global_sum(*world(), owned)) TEST_EQUALITY(n, 1.0);
}

/// Triangles at owned vertices are there with the regions on their sides, each checked once.
void check_triangles(const Mesh& whole, const Share& share, Teuchos::FancyOStream& out,
                     bool& success) {
  const Excerpt mine = share.excerpt();
  std::vector<double> answered(whole.triangles.size(), 0.0);
  std::set<long long> known(share.numbers.triangles.begin(), share.numbers.triangles.end());
  const std::set<int> own = [&] {
    std::set<int> numbers;
    for (std::size_t v = 0; v < share.is_owned.size(); ++v)
      if (share.is_owned[v]) numbers.insert(share.numbers.vertices[v]);
    return numbers;
  }();
  for (std::size_t i = 0; i < whole.triangles.size(); ++i)
    for (const int v : whole.triangles[i])
      if (own.count(v) > 0) TEST_ASSERT(known.count(static_cast<long long>(i)) > 0);
  for (std::size_t i = 0; i < share.mesh.triangles.size(); ++i) {
    answered[share.numbers.triangles[i]] += mine.has(share.mesh.triangles[i]);
    const std::string& surface = share.mesh.surfaces[share.mesh.triangle_surface[i]].name;
    const bool is_inside = surface == "interface" || surface == "layer";
    const auto& [a, b] = share.regions_beside[i];
    TEST_EQUALITY(a >= 0 && b >= 0, is_inside);
    if (surface == "interface") TEST_EQUALITY(a + b, 1);  // fluid and media
  }
  for (const double n : global_sum(*world(), answered)) TEST_EQUALITY(n, 1.0);
}

TEUCHOS_UNIT_TEST(share, has_all_around_its_vertices_however_the_mesh_is_cut) {
  const Mesh whole = tube();
  for (const Partitioner by : {Partitioner::metis, Partitioner::geometric}) {
    const Share share = share_of(whole, by);
    check_share(whole, share, out, success);
    check_triangles(whole, share, out, success);
  }
}

TEUCHOS_UNIT_TEST(share, ghosts_receive_what_their_owners_have) {
  const Share share = share_of(tube(), Partitioner::geometric);
  std::vector<double> values(share.is_owned.size(), -1.0);
  for (std::size_t v = 0; v < values.size(); ++v)
    if (share.is_owned[v]) values[v] = 0.5 * share.numbers.vertices[v];
  share.ghosts.update(values);
  for (std::size_t v = 0; v < values.size(); ++v)
    TEST_EQUALITY(values[v], 0.5 * share.numbers.vertices[v]);
}

std::string message_of_whole(const Mesh& mesh) {
  try {
    validate(mesh, "tube");
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

std::string message_of_ranks(const Mesh& mesh) {
  try {
    Slab slab = slab_of(mesh, world());
    on_all(*world(), [&] {
      check_tags(slab.rows, "tube");
      check_rows(slab.rows, slab.place(), "tube");
    });
    mesh::share_of(std::move(slab), tube_fluid, Partitioner::geometric, "tube");
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEUCHOS_UNIT_TEST(share, damage_is_told_as_one_rank_tells_it) {
  const auto compare = [&](auto change) {
    Mesh mesh = make_tube(smallest_tube());
    change(mesh);
    TEST_ASSERT(!message_of_whole(mesh).empty());
    TEST_EQUALITY(message_of_ranks(mesh), message_of_whole(mesh));
  };
  compare([](Mesh& m) { m.tets[1][0] = 99; });
  compare([](Mesh& m) { m.tets[1][0] = m.tets[1][3]; });
  compare([](Mesh& m) { m.tet_region.back() = 3; });
  compare([](Mesh& m) { m.surfaces[1].name = ""; });
  compare([](Mesh& m) { m.triangles.back()[1] = 99; });
  compare([](Mesh& m) { m.vertices[5][1] = std::numeric_limits<double>::quiet_NaN(); });
  compare([](Mesh& m) { m.vertices.push_back({1, 2, 3}); });
  compare([](Mesh& m) { std::swap(m.tets[4][0], m.tets[4][1]); });
  compare([](Mesh& m) {
    m.triangles.pop_back();
    m.triangle_surface.pop_back();
  });
  compare([](Mesh& m) {
    m.triangles.push_back(m.triangles[0]);
    m.triangle_surface.push_back(1);
  });
}

TEUCHOS_UNIT_TEST(share, doubled_tetrahedron_is_found_at_one_of_its_faces) {
  Mesh mesh = make_tube(smallest_tube());
  mesh.tets.push_back(mesh.tets[10]);
  mesh.tet_region.push_back(mesh.tet_region[10]);
  const std::string message = message_of_ranks(mesh);
  TEST_INEQUALITY(message.find("tube: the face at ("), std::string::npos);
  TEST_INEQUALITY(message.find(" and 54, expected at most two."), std::string::npos);
}

TEUCHOS_UNIT_TEST(share, triangle_that_is_no_face_is_refused) {
  Mesh mesh = make_tube(smallest_tube());
  mesh.triangles.push_back({0, 1, static_cast<int>(mesh.vertices.size()) - 1});
  mesh.triangle_surface.push_back(1);
  TEST_ASSERT(fails_with("is not a face of any tetrahedron", out,
                         [&] { share_of(mesh, Partitioner::metis); }));
}

TEUCHOS_UNIT_TEST(share, interface_is_checked_as_in_the_whole) {
  const Mesh whole = tube();
  const Share share = share_of(whole, Partitioner::geometric);
  const std::vector<std::string> fluid{"fluid"}, wall{"media", "adventitia"};
  TEST_NOTHROW(check_interface(share, fluid, wall, {"interface"}));
  const auto both_fail = [&](const std::string& part, const std::vector<std::string>& walls,
                             const std::vector<std::string>& surfaces) {
    return fails_with(part, out, [&] { check_interface(whole, fluid, walls, surfaces); }) &&
           fails_with(part, out, [&] { check_interface(share, fluid, walls, surfaces); });
  };
  TEST_ASSERT(both_fail("is both fluid and wall", {"fluid"}, {"interface"}));
  TEST_ASSERT(both_fail("lies between regions \"media\" and \"adventitia\"", wall, {"layer"}));
  TEST_ASSERT(both_fail("is not on an interface surface", wall, {}));
  TEST_ASSERT(both_fail("does not conform", wall, {"inlet"}));
  const auto inlet = std::count(whole.triangle_surface.begin(), whole.triangle_surface.end(),
                                surface_index(whole, "inlet"));
  TEST_ASSERT(both_fail("(" + std::to_string(inlet) + " of ", wall, {"interface", "inlet"}));
}

}  // namespace
