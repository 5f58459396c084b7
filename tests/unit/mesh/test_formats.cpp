#include <Teuchos_UnitTestHarness.hpp>
#include <climits>
#include <iterator>
#include <sstream>

#include "helpers.hpp"
#include "tunica/mesh/faces.hpp"
#include "tunica/mesh/formats/gmsh.hpp"
#include "tunica/mesh/formats/hdf5.hpp"
#include "tunica/mesh/formats/text_scanner.hpp"
#include "tunica/mesh/number_runs.hpp"
#include "tunica/mesh/read.hpp"
#include "tunica/mesh/write.hpp"

using namespace tunica::mesh;

namespace {

const std::string nodes =
    "$Nodes\n5\n10 0 0 0\n20 1 0 0\n30 0 1 0\n40 0 0 1\n50 9 9 9\n$EndNodes\n";
const std::string head = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n";

/// One tetrahedron in Gmsh 2.2 with sparse numbers, tags and an unused node.
std::string one_tet(const std::string& corners) {
  return head + nodes +
         "$Elements\n6\n1 15 2 0 1 50\n2 2 2 11 1 10 20 30\n3 2 2 11 1 10 20 40\n"
         "4 2 2 0 1 10 30 40\n5 2 2 -11 1 20 30 40\n77 4 2 7 1 " +
         corners + "\n$EndElements\n";
}

Mesh read_text_as(const std::string& name, const std::string& text) {
  const TemporaryFile file(name);
  file.fill(text);
  return read(file.path);
}

TEUCHOS_UNIT_TEST(mesh_formats, netgen_and_gmsh_files_of_one_mesh_agree) {
  const Mesh gmsh = read(data_folder + "/mesh-tube-small.msh");
  const Mesh netgen = read(data_folder + "/mesh-tube-small.vol");
  TEST_EQUALITY(gmsh.vertices.size(), 647u);
  TEST_EQUALITY(gmsh.tets.size(), 3031u);
  TEST_ASSERT(gmsh.vertices == netgen.vertices);
  TEST_ASSERT(gmsh.tet_region == netgen.tet_region);
  TEST_ASSERT(gmsh.triangles == netgen.triangles);
  TEST_ASSERT(gmsh.triangle_surface == netgen.triangle_surface);
  for (std::size_t t = 0; t < gmsh.tets.size(); ++t) {
    auto a = gmsh.tets[t], b = netgen.tets[t];
    std::sort(a.begin(), a.end());
    std::sort(b.begin(), b.end());
    TEST_ASSERT(a == b);
  }
}

TEUCHOS_UNIT_TEST(mesh_formats, round_trips_are_exact) {
  const Mesh small = read(data_folder + "/mesh-tube-small.msh");
  for (const Mesh& mesh : {make_tube(Tube()), small, with_vectors(small)}) {
    const TemporaryFile h5("round.h5"), v22("round22.msh");
    write(mesh, h5.path);
    write(mesh, v22.path);
    TEST_ASSERT(are_identical(read(h5.path), mesh));
    TEST_ASSERT(are_identical(read(v22.path), mesh));
  }
}

TEUCHOS_UNIT_TEST(mesh_formats, gmsh_41_groups_elements_and_keeps_the_mesh) {
  const Mesh mesh = with_vectors(read(data_folder + "/mesh-tube-small.msh"));
  const TemporaryFile v41("round41.msh"), again("again41.msh");
  write_gmsh(mesh, v41.path, GmshVersion::v41);
  const Mesh grouped = read(v41.path);
  TEST_ASSERT(grouped.vertices == mesh.vertices);
  auto sorted = [](const Mesh& m) {
    std::vector<std::pair<std::array<int, 4>, int>> tets;
    for (std::size_t t = 0; t < m.tets.size(); ++t) tets.emplace_back(m.tets[t], m.tet_region[t]);
    std::sort(tets.begin(), tets.end());
    return tets;
  };
  TEST_ASSERT(sorted(grouped) == sorted(mesh));
  for (std::size_t t = 0; t < grouped.tets.size(); ++t)
    TEST_ASSERT(grouped.tet_vectors.at(0).values[t] == centroid(grouped, t));
  write_gmsh(grouped, again.path, GmshVersion::v41);
  TEST_ASSERT(are_identical(read(again.path), grouped));
}

/// A set of values on elements, as Gmsh's views have it.
std::string element_data(const std::string& name, int components, const std::string& rows, int n) {
  return "$ElementData\n1\n\"" + name + "\"\n1\n0.0\n3\n0\n" + std::to_string(components) + "\n" +
         std::to_string(n) + "\n" + rows + "$EndElementData\n";
}

TEUCHOS_UNIT_TEST(mesh_formats, gmsh_vectors_on_tetrahedra_are_kept_and_other_data_passed_over) {
  const std::string mesh = one_tet("10 20 30 40");
  const Mesh read =
      read_text_as("data.msh", mesh + element_data("stress", 1, "77 5\n", 1) +
                                   element_data("axial", 3, "2 7 7 7\n77 0.5 0 -1\n", 2) +
                                   element_data("none", 3, "2 7 7 7\n", 1));
  TEST_EQUALITY(read.tet_vectors.size(), 2u);
  TEST_EQUALITY(read.tet_vectors[0].name, "axial");
  TEST_ASSERT(read.tet_vectors[0].values == std::vector<tunica::Vec3>({{0.5, 0.0, -1.0}}));
  TEST_ASSERT(read.tet_vectors[1].values == std::vector<tunica::Vec3>({{0.0, 0.0, 0.0}}));
  const std::string data = element_data("axial", 3, "77 0 0 1\n", 1);
  const auto refuses = [&](const std::string& part, const std::string& text) {
    return fails_with(part, out, [&] { read_text_as("bad-data.msh", text); });
  };
  TEST_ASSERT(refuses("a second $ElementData \"axial\"", mesh + data + data));
  TEST_ASSERT(refuses("$ElementData before $Elements", head + nodes + data));
  TEST_ASSERT(
      refuses("a value on an element", mesh + element_data("axial", 3, "77 0 0 north\n", 1)));
  TEST_ASSERT(
      refuses("a name without quotation marks", mesh + element_data("a<b", 3, "77 0 0 1\n", 1)));
}

/// As Gmsh writes it: points and curves with groups and ends, parametric nodes, empty blocks,
/// and a section that plays no role.
const std::string as_gmsh_41 =
    "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$PhysicalNames\n3\n0 5 \"corner\"\n2 11 \"the skin\"\n"
    "3 7 \"fluid\"\n$EndPhysicalNames\n$Entities\n2 1 2 1\n1 0 0 0 1 5 \n2 1 0 0 0 \n"
    "1 0 0 0 1 0 0 2 8 9 2 1 -2 \n1 0 0 0 1 1 0 1 11 1 1 \n2 0 0 0 1 1 1 1 -11 1 1 \n"
    "3 0 0 0 1 1 1 1 7 2 1 -2 \n$EndEntities\n$Nodes\n5 4 1 9\n0 1 0 1\n1\n0 0 0\n0 2 0 1\n2\n"
    "1 0 0\n1 1 1 0\n2 1 1 1\n3\n0 1 0 0.25 0.75\n3 3 0 1\n9\n0 0 1\n$EndNodes\n$Elements\n5 7 1 "
    "7\n"
    "0 1 15 1\n1 1 \n1 1 1 1\n2 1 2 \n2 1 2 1\n3 1 2 3 \n2 2 2 3\n4 1 2 9 \n5 1 3 9 \n6 2 3 9 \n"
    "3 3 4 1\n7 1 2 3 9 \n$EndElements\n$NodeData\n1\n\"x\"\n$EndNodeData\n";

TEUCHOS_UNIT_TEST(mesh_formats, gmsh_41_takes_the_groups_from_the_entities) {
  const Mesh mesh = read_text_as("real41.msh", as_gmsh_41);
  TEST_EQUALITY(mesh.vertices.size(), 4u);
  TEST_EQUALITY(mesh.vertices[3][2], 1.0);
  TEST_EQUALITY(mesh.tets.size(), 1u);
  TEST_EQUALITY(mesh.regions[0].name, "fluid");
  TEST_EQUALITY(mesh.triangles.size(), 4u);
  TEST_EQUALITY(mesh.surfaces.size(), 1u);
  TEST_EQUALITY(mesh.surfaces[0].name, "the skin");
}

TEUCHOS_UNIT_TEST(mesh_formats, vtu_holds_every_cell_with_its_tag) {
  const Mesh mesh = make_tube(smallest_tube());
  const TemporaryFile file("cells.vtu");
  write(mesh, file.path);
  const std::string text = read_text(file.path);
  const auto values_of = [&](const std::string& name) {
    const std::size_t start = text.find('\n', text.find("Name=\"" + name + "\""));
    std::istringstream in(text.substr(start, text.find("</DataArray>", start) - start));
    return std::vector<double>(std::istream_iterator<double>(in), std::istream_iterator<double>());
  };
  const std::size_t cells = mesh.tets.size() + mesh.triangles.size();
  TEST_EQUALITY(values_of("points").size(), 3 * mesh.vertices.size());
  TEST_EQUALITY(values_of("connectivity").size(), 4 * mesh.tets.size() + 3 * mesh.triangles.size());
  TEST_EQUALITY(values_of("offsets").back(), 4.0 * mesh.tets.size() + 3.0 * mesh.triangles.size());
  for (const std::string name : {"offsets", "types", "region", "surface"})
    TEST_EQUALITY(values_of(name).size(), cells);
  TEST_EQUALITY(values_of("region")[0], mesh.regions[mesh.tet_region[0]].id);
  TEST_EQUALITY(values_of("surface").back(), mesh.surfaces[mesh.triangle_surface.back()].id);
}

TEUCHOS_UNIT_TEST(mesh_formats, gmsh_numbers_may_have_gaps_and_tags_may_have_no_names) {
  const Mesh mesh = read_text_as("one.msh", one_tet("10 20 30 40"));
  TEST_EQUALITY(mesh.vertices.size(), 4u);
  TEST_EQUALITY(mesh.regions[0].name, "region-7");
  TEST_EQUALITY(mesh.surfaces[0].name, "surface-0");
  TEST_EQUALITY(mesh.surfaces[1].name, "surface-11");
}

TEUCHOS_UNIT_TEST(mesh_formats, negative_tetrahedra_are_flipped_if_all_are) {
  const Mesh mesh = read_text_as("flip.msh", one_tet("10 20 40 30"));
  TEST_FLOATING_EQUALITY(volume(mesh, 0), 1.0 / 6.0, 1e-15);
}

TEUCHOS_UNIT_TEST(mesh_formats, inverted_element_is_named_by_its_number_in_the_file) {
  std::string text = read_text(data_folder + "/mesh-tube-small.msh");
  const std::string last = "4261 4 2 3 3 24 43 422 44";
  text.replace(text.find(last), last.size(), "4261 4 2 3 3 24 43 44 422");
  TEST_ASSERT(fails_with("inverted element: element 4261 of region \"adventitia\"", out,
                         [&] { read_text_as("inverted.msh", text); }));
}

TEUCHOS_UNIT_TEST(mesh_formats, untagged_triangles_inside_are_dropped) {
  Mesh mesh = make_tube(Tube());
  const std::size_t before = mesh.triangles.size();
  for (Tag& tag : mesh.surfaces)
    if (tag.name == "layer" || tag.name == "inlet") tag.id = tag.name == "layer" ? 0 : 50;
  const TemporaryFile file("layer.msh");
  write(mesh, file.path);
  const Mesh found = read(file.path);
  const auto layer = std::count_if(mesh.triangle_surface.begin(), mesh.triangle_surface.end(),
                                   [&](int s) { return mesh.surfaces[s].name == "layer"; });
  TEST_ASSERT(layer > 0);
  TEST_EQUALITY(found.triangles.size(), before - layer);
}

TEUCHOS_UNIT_TEST(mesh_formats, unsupported_files_say_what_to_do) {
  const auto fails = [&](const std::string& part, const std::string& text) {
    return fails_with(part, out, [&] { read_text_as("odd.msh", text); });
  };
  TEST_ASSERT(fails("expected ASCII", "$MeshFormat\n4.1 1 8\n"));
  TEST_ASSERT(fails("Gmsh version 4.0", "$MeshFormat\n4 0 8\n$EndMeshFormat\n"));
  TEST_ASSERT(fails("expected $MeshFormat", "something else"));
  TEST_ASSERT(fails("Gmsh type 11", head + nodes + "$Elements\n1\n1 11 2 1 1 10 20 30 40 10 20\n"));
  TEST_ASSERT(fails(":7: found \"1.x\"", head + "$Nodes\n2\n1 0 0 0\n2 1.x 0 0\n$EndNodes\n"));
  TEST_ASSERT(
      fails("second node with the number 1", head + "$Nodes\n2\n1 0 0 0\n1 1 0 0\n$EndNodes"));
  TEST_ASSERT(fails("can hold only", head + "$Nodes\n2000000000\n1 0 0 0\n"));
  TEST_ASSERT(fails("expected 0 or more", head + "$Nodes\n-3\n1 0 0 0\n"));
  TEST_ASSERT(fails("node 60 is not in $Nodes", one_tet("10 20 30 60")));
  TEST_ASSERT(fails("partitioned", "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$PartitionedEntities\n"));
  TEST_ASSERT(fails("2 physical groups",
                    "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Entities\n0 0 0 1\n"
                    "1 0 0 0 1 1 1 2 5 6 0\n$EndEntities\n"));
  TEST_ASSERT(fails_with("no such file", out, [] { read("/nowhere/tube.msh"); }));
  TEST_ASSERT(fails_with("not a known mesh format", out, [] { read(data_folder); }));
  TEST_ASSERT(
      fails_with("not a known mesh format", out, [&] { read_text_as("odd.txt", "hello"); }));
}

TEUCHOS_UNIT_TEST(text_scanner, pieces_of_any_size_give_the_same_words) {
  const std::string text =
      "# head\n  12 -3.5e-2\n# 7 7\n#\nname \"two words\" behind it \n\n\tlast";
  const TemporaryFile file("scanned.txt");
  file.fill(text);
  for (std::size_t piece = 1; piece <= text.size() + 1; ++piece) {
    TextScanner in(file.path, '#', piece);  // the tests below look at what they get twice
    const long long number = in.integer("a");
    const double real = in.real("b");
    const std::string next(in.peek());
    const long long line = in.line();
    const std::string word(in.word("c")), quoted = in.quoted("d"), rest = in.rest_of_line();
    TEST_EQUALITY(number, 12);
    TEST_EQUALITY(real, -0.035);
    TEST_EQUALITY(next, "name");
    TEST_EQUALITY(line, 5);
    TEST_EQUALITY(word, "name");
    TEST_EQUALITY(quoted, "two words");
    TEST_EQUALITY(rest, "behind it");
    TEST_ASSERT(!in.is_at_end());
    TEST_EQUALITY(in.line(), 7);
    const std::string last(in.word("e"));
    TEST_EQUALITY(last, "last");
    TEST_ASSERT(in.is_at_end());
    TEST_ASSERT(
        fails_with("scanned.txt:7: the file ends here, expected f", out, [&] { in.word("f"); }));
  }
}

TEUCHOS_UNIT_TEST(text_scanner, marks_and_ends_of_lines_are_those_of_any_system) {
  const TemporaryFile file("marked.txt");
  for (const std::string mark : {"", "\xef\xbb\xbf"})
    for (const std::string end : {"\n", "\r\n", "\r"}) {
      file.fill(mark + "# head" + end + "1 2" + end + end + "name behind it" + end + "last");
      for (const std::size_t piece : {1, 2, 5, 100}) {
        TextScanner in(file.path, '#', piece);
        const long long sum = in.integer("a") + in.integer("b");
        TEST_EQUALITY(sum, 3);
        const std::string word(in.word("c")), rest = in.rest_of_line(), last(in.word("d"));
        TEST_EQUALITY(word + "|" + rest + "|" + last, "name|behind it|last");
        TEST_EQUALITY(in.line(), 5);
      }
    }
  file.fill(std::string("\xff\xfe$\0M\0", 6));
  TEST_ASSERT(fails_with("expected UTF-8", out, [&] { TextScanner in(file.path); }));
}

TEUCHOS_UNIT_TEST(text_scanner, a_count_is_what_the_rest_of_the_file_can_hold) {
  const TemporaryFile file("counted.txt");
  file.fill("3 1 2 3");
  for (const std::size_t piece : {1, 3, 100}) {
    TextScanner in(file.path, 0, piece);
    const long long three = in.count("entries", 2), one = in.count("entries", 2);
    TEST_EQUALITY(three, 3);
    TEST_EQUALITY(one, 1);
    TEST_ASSERT(fails_with("can hold only 1", out, [&] { in.count("entries", 2); }));
  }
}

TEUCHOS_UNIT_TEST(number_runs, find_the_places_of_numbers_in_any_order) {
  const std::vector<long long> numbers{5, 6, 7, 1, 2, 8, 100, 3, 4, -1, 0, LLONG_MAX, LLONG_MIN};
  NumberRuns runs;
  for (const long long number : numbers) TEST_ASSERT(runs.add(number));
  for (std::size_t k = 0; k < numbers.size(); ++k)
    TEST_EQUALITY(runs.find(numbers[k]), static_cast<long long>(k));
  for (const long long none : {-2LL, 9LL, 99LL, 101LL, LLONG_MAX - 1, LLONG_MIN + 1})
    TEST_EQUALITY(runs.find(none), -1);
  for (const long long number : numbers) TEST_ASSERT(!runs.add(number));
  TEST_ASSERT(runs.add(50));  // those refused have taken places
  TEST_EQUALITY(runs.find(50), 2 * static_cast<long long>(numbers.size()));
  TEST_ASSERT(!runs.add(50));
  TEST_ASSERT(runs.add(51));
  TEST_EQUALITY(runs.find(51), runs.find(50) + 2);
}

TEUCHOS_UNIT_TEST(mesh_formats, failed_write_leaves_nothing) {
  const Mesh mesh = make_tube(smallest_tube());
  TEST_ASSERT(fails_with("folder does not exist", out, [&] { write(mesh, "/nowhere/a.h5"); }));
  TEST_ASSERT(fails_with("unknown extension", out, [&] { write(mesh, "a.stl"); }));
  const TemporaryFile folder("folder.h5");
  std::filesystem::create_directory(folder.path);
  TEST_ASSERT(fails_with("is a directory", out, [&] { write(mesh, folder.path); }));
  TEST_ASSERT(std::filesystem::is_empty(folder.path));
  for (const char* name : {"full.h5", "full.msh", "full.vtu"}) {
    if (!std::filesystem::exists("/dev/full")) continue;
    const TemporaryFile target(name);
    const std::string draft = target.path + ".tmp";
    std::filesystem::create_symlink("/dev/full", draft);
    TEST_THROW(write(mesh, target.path), tunica::Error);
    TEST_ASSERT(!std::filesystem::exists(target.path));
    TEST_ASSERT(!std::filesystem::exists(std::filesystem::symlink_status(draft)));
  }
}

}  // namespace
