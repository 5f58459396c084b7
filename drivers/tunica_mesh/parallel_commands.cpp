#include "tunica_mesh/parallel_commands.hpp"

#include <cstdio>

#include "tunica/base/agreement.hpp"
#include "tunica/base/error.hpp"
#include "tunica/base/memory.hpp"
#include "tunica/base/rows.hpp"
#include "tunica/mesh/distributed/refine.hpp"
#include "tunica/mesh/distributed/share.hpp"
#include "tunica/mesh/formats/gmsh.hpp"
#include "tunica/mesh/validate.hpp"
#include "tunica/mesh/write.hpp"
#include "tunica_mesh/report.hpp"

using namespace tunica;

namespace {

/// What a case would check of it, but for fluid and wall.
void check(const mesh::Slab& slab, const std::string& path) {
  const std::vector<bool> is_fluid(slab.rows.regions.size(), true);
  mesh::share_of(slab, is_fluid, mesh::Partitioner::automatic, path);
}

bool ends_with(const std::string& text, const std::string& end) {
  return text.size() > end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

void write_whole(const mesh::Slab& slab, const std::string& path, mesh::GmshVersion version) {
  const mesh::Mesh whole = mesh::gathered(slab);
  on_root(*slab.comm, [&] {
    if (ends_with(path, ".msh"))
      mesh::write_gmsh(whole, path, version);
    else
      mesh::write(whole, path);
    report(whole, path);
  });
}

void write_rows(const mesh::Slab& slab, const std::string& path) {
  mesh::write_slab(slab, path);
  if (slab.comm->getRank() == 0)
    std::printf("%s: %lld vertices, %lld tetrahedra, %lld triangles\n", path.c_str(), slab.vertices,
                slab.tets, slab.triangles);
}

/// Several ranks write our own format together; the others are text, and one writes them.
void save(const mesh::Slab& slab, const std::string& path,
          mesh::GmshVersion version = mesh::GmshVersion::v22) {
  if (ends_with(path, ".h5") && slab.comm->getSize() > 1)
    write_rows(slab, path);
  else
    write_whole(slab, path, version);
}

/// What a rank gets.
struct Part {
  long long counted, others, fluid_vertices, wall_vertices;
  double megabytes;
};

Part part_of(const mesh::Share& share, const std::vector<bool>& is_fluid) {
  std::vector<char> fields(share.mesh.vertices.size(), 0);
  Part part{};
  for (std::size_t t = 0; t < share.mesh.tets.size(); ++t) {
    ++(share.counts(t) ? part.counted : part.others);
    const bool fluid = is_fluid[share.mesh.tet_region[t]];
    for (const int v : share.mesh.tets[t]) fields[v] |= fluid ? mesh::in_fluid : mesh::in_wall;
  }
  for (std::size_t v = 0; v < fields.size(); ++v) {
    if (!share.is_owned[v]) continue;
    part.fluid_vertices += (fields[v] & mesh::in_fluid) != 0;
    part.wall_vertices += (fields[v] & mesh::in_wall) != 0;
  }
  part.megabytes = peak_memory();
  return part;
}

}  // namespace

Arguments::Command refine_command() {
  return {
      "refine",
      {"MESH", "OUT"},
      "Cuts every tetrahedron into 8; on several ranks also meshes that no single rank can hold.",
      {{"times", "1", "how often"},
       {"project", "", "surfaces to be rounded to cylinders about the z axis"},
       overwrite_option()}};
}

void refine_mesh(const Arguments& arguments, const CommPtr& comm) {
  const int times = arguments.integer("times");
  TUNICA_CHECK(times >= 1 && times <= 8,
               "tunica-mesh refine: --times is " + std::to_string(times) + ", expected 1..8");
  on_root(*comm, [&] { arguments.new_file(1); });
  mesh::Slab slab = mesh::read_slab(arguments.file(0), comm);
  check(slab, arguments.file(0));
  for (int i = 0; i < times; ++i) slab = mesh::refine(slab, arguments.names("project"));
  save(slab, arguments.file(1));
}

Arguments::Command convert_command() {
  return {"convert",
          {"MESH", "OUT"},
          "Reads .msh, .vol or .h5 and writes .msh, .h5 or .vtu; on several ranks also meshes to "
          ".h5 that no single rank can hold.",
          {{"gmsh", "2.2", "version of a .msh file: 2.2 or 4.1"}, overwrite_option()}};
}

void convert_mesh(const Arguments& arguments, const CommPtr& comm) {
  const std::string gmsh = arguments.text("gmsh");
  TUNICA_CHECK(gmsh == "2.2" || gmsh == "4.1",
               "tunica-mesh convert: --gmsh is \"" + gmsh + "\", expected 2.2 or 4.1");
  on_root(*comm, [&] { arguments.new_file(1); });
  const mesh::Slab slab = mesh::read_slab(arguments.file(0), comm);
  check(slab, arguments.file(0));
  save(slab, arguments.file(1), gmsh == "4.1" ? mesh::GmshVersion::v41 : mesh::GmshVersion::v22);
}

Arguments::Command partition_command() {
  return {"partition",
          {"MESH"},
          "Shows the share of a mesh that each rank of a run gets: mpirun -n 4 tunica-mesh "
          "partition MESH.",
          {{"fluid", "fluid", "regions of the fluid, separated by commas, or none"},
           {"by", "automatic", "automatic, metis or geometric, as \"Mesh / partitioner\""}}};
}

void show_partition(const Arguments& arguments, const CommPtr& comm) {
  const mesh::Partitioner by = mesh::partitioner_of(arguments.text("by"));
  const std::string& path = arguments.file(0);
  mesh::Slab slab = mesh::read_slab(path, comm);
  std::vector<bool> is_fluid(slab.rows.regions.size(), false);
  for (const std::string& name : arguments.names("fluid"))
    is_fluid[mesh::region_index(slab.rows, name)] = true;
  const auto fields = mesh::vertex_fields(slab, is_fluid, path);
  const mesh::SlabPartition partition = mesh::partition(slab, is_fluid, fields, by, path);
  const mesh::Balance balance = mesh::balance(slab, fields, partition);
  const mesh::Share share = mesh::distribute(std::move(slab), partition, path);
  const auto parts = gather_rows(*comm, std::vector<Part>{part_of(share, is_fluid)});
  if (comm->getRank() != 0) return;
  std::printf("%6s %12s %12s %15s %14s %9s\n", "rank", "tetrahedra", "of others", "fluid vertices",
              "wall vertices", "peak MB");
  for (std::size_t r = 0; r < parts.size(); ++r)
    std::printf("%6zu %12lld %12lld %15lld %14lld %9.0f\n", r, parts[r].counted, parts[r].others,
                parts[r].fluid_vertices, parts[r].wall_vertices, parts[r].megabytes);
  std::printf(
      "most vertices of a rank over the mean: fluid %.3f, wall %.3f; %.2f %% of the tetrahedra "
      "are cut\n",
      balance.fluid, balance.wall, 100.0 * balance.cut);
}
