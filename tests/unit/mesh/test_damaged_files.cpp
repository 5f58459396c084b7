#include <Teuchos_UnitTestHarness.hpp>

#include "helpers.hpp"
#include "tunica/mesh/formats/gmsh.hpp"
#include "tunica/mesh/formats/hdf5.hpp"
#include "tunica/mesh/read.hpp"
#include "tunica/mesh/write.hpp"

using namespace tunica::mesh;

namespace {

/// Reads the text as a file; true if that throws tunica::Error (anything else gets through).
bool is_refused(const TemporaryFile& file, const std::string& text) {
  file.fill(text);
  try {
    read(file.path);
  } catch (const tunica::Error&) {
    return true;
  }
  return false;
}

/// Number of truncations, at every step-th line end, that are read as if they were whole.
int accepted_at_lines(const std::string& text, const TemporaryFile& file, int step) {
  int accepted = 0, line = 0;
  for (std::size_t at = 0; (at = text.find('\n', at)) != text.npos; ++at)
    if (line++ % step == 0 && at + 1 < text.size())
      accepted += !is_refused(file, text.substr(0, at));
  return accepted;
}

int accepted_at_bytes(const std::string& text, const TemporaryFile& file, std::size_t step) {
  int accepted = 0;
  const std::size_t end = text.find_last_not_of('\n');
  for (std::size_t at = 0; at <= end; at += step) accepted += !is_refused(file, text.substr(0, at));
  return accepted;
}

std::string written(const Mesh& mesh, GmshVersion version) {
  const TemporaryFile file("written.msh");
  write_gmsh(mesh, file.path, version);
  return read_text(file.path);
}

/// A cylinder of six tetrahedra.
Mesh six_tets() {
  Tube tube = smallest_tube();
  tube.with_wall = false;
  return make_tube(tube);
}

TEUCHOS_UNIT_TEST(mesh_damaged_files, gmsh_cut_at_every_tenth_line_is_refused) {
  const std::string v22 = read_text(data_folder + "/mesh-tube-small.msh");
  const TemporaryFile file("cut.msh");
  TEST_EQUALITY(accepted_at_lines(v22, file, 10), 0);
  const std::string v41 = written(read(data_folder + "/mesh-tube-small.msh"), GmshVersion::v41);
  TEST_EQUALITY(accepted_at_lines(v41, file, 10), 0);
}

TEUCHOS_UNIT_TEST(mesh_damaged_files, netgen_cut_at_every_tenth_line_is_refused) {
  const TemporaryFile file("cut.vol");
  TEST_EQUALITY(accepted_at_lines(read_text(data_folder + "/mesh-tube-small.vol"), file, 10), 0);
}

TEUCHOS_UNIT_TEST(mesh_damaged_files, gmsh_cut_at_any_byte_is_refused) {
  const TemporaryFile file("bytes.msh");
  const Mesh mesh = six_tets();
  for (const GmshVersion version : {GmshVersion::v22, GmshVersion::v41})
    TEST_EQUALITY(accepted_at_bytes(written(mesh, version), file, 1), 0);
}

TEUCHOS_UNIT_TEST(mesh_damaged_files, hdf5_cut_at_any_byte_is_refused) {
  const TemporaryFile file("bytes.h5"), whole("whole.h5");
  write(make_tube(smallest_tube()), whole.path);
  TEST_EQUALITY(accepted_at_bytes(read_text(whole.path), file, 61), 0);
}

TEUCHOS_UNIT_TEST(mesh_damaged_files, changed_letters_are_read_or_refused_but_never_crash) {
  const TemporaryFile file("changed.msh");
  const Mesh mesh = six_tets();
  int refused = 0;
  for (const GmshVersion version : {GmshVersion::v22, GmshVersion::v41}) {
    const std::string text = written(mesh, version);
    for (const char letter : {'9', '-', ' '})
      for (std::size_t at = 0; at < text.size(); at += 3) {
        std::string changed = text;
        changed[at] = letter;
        refused += is_refused(file, changed);
      }
  }
  TEST_ASSERT(refused > 1000);
}

TEUCHOS_UNIT_TEST(mesh_damaged_files, hdf5_names_the_bad_dataset) {
  const TemporaryFile file("bad.h5");
  Mesh mesh = make_tube(smallest_tube());
  mesh.tet_region.pop_back();
  write(mesh, file.path);
  TEST_ASSERT(fails_with("/tet_region has 53 rows, expected 54 as in /tets", out,
                         [&] { read(file.path); }));
  mesh = make_tube(smallest_tube());
  mesh.tets[3][2] = 1000000;
  write(mesh, file.path);
  TEST_ASSERT(fails_with("tetrahedron 3 has vertex 1000000", out, [&] { read(file.path); }));
  mesh = Mesh();
  write(mesh, file.path);
  TEST_ASSERT(fails_with("no tetrahedra", out, [&] { read(file.path); }));
}

TEUCHOS_UNIT_TEST(mesh_damaged_files, hdf5_detects_changed_data_by_checksum) {
  const TemporaryFile file("checksum.h5");
  write(make_tube(smallest_tube()), file.path);
  const std::string whole = read_text(file.path);
  // Deflated data begin with 0x78 0x01; the tenth byte after that is inside a dataset.
  std::size_t at = whole.find("\x78\x01");
  TEST_ASSERT(at != whole.npos);
  int checked = 0;
  for (; at != whole.npos && at + 10 < whole.size(); at = whole.find("\x78\x01", at + 10)) {
    std::string changed = whole;
    changed[at + 10] = static_cast<char>(changed[at + 10] ^ 0x55);
    TEST_ASSERT(is_refused(file, changed));
    ++checked;
  }
  TEST_ASSERT(checked >= 3);
}

}  // namespace
