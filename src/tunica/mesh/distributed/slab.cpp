#include "tunica/mesh/distributed/slab.hpp"

#include <mpi.h>

#include <algorithm>
#include <array>
#include <limits>

#include "tunica/base/agreement.hpp"
#include "tunica/base/error.hpp"
#include "tunica/base/hash.hpp"
#include "tunica/base/reduce.hpp"
#include "tunica/io/atomic_file.hpp"
#include "tunica/io/parallel_hdf5.hpp"
#include "tunica/mesh/distributed/broadcast.hpp"
#include "tunica/mesh/distributed/rows.hpp"
#include "tunica/mesh/distributed/text_mesh.hpp"
#include "tunica/mesh/formats/hdf5.hpp"
#include "tunica/mesh/read.hpp"

namespace tunica::mesh {

namespace {

Slab read_own(const std::string& path, const CommPtr& comm) {
  Hdf5Rows found;
  on_all(*comm, [&] { found = read_hdf5_rows(path, comm->getRank(), comm->getSize()); });
  return {comm, std::move(found.rows), found.vertices, found.tets, found.triangles};
}

template <class Item>
void add_rows(std::uint64_t& sum, char kind, long long first, const std::vector<Item>& rows) {
  for (const Item& row : rows) {
    std::uint64_t hash = hash_bytes(&kind, 1);
    hash = hash_bytes(&first, sizeof first, hash);
    sum += hash_bytes(&row, sizeof row, hash);
    ++first;
  }
}

/// Regions and surfaces, by what cases call them.
void add_names(std::uint64_t& sum, char kind, const std::vector<Tag>& tags) {
  for (std::size_t k = 0; k < tags.size(); ++k) {
    const std::uint64_t hash = hash_bytes(&k, sizeof k, hash_bytes(&kind, 1));
    sum += hash_bytes(tags[k].name.data(), tags[k].name.size(), hash);
  }
}

}  // namespace

Place Slab::place() const {
  const auto first = [this](long long total) { return portion_of(total, *comm).first; };
  return {first(vertices), first(tets), first(triangles), vertices};
}

Slab slab_of(const Mesh& whole, const CommPtr& comm) {
  std::array<long long, 3> counts{static_cast<long long>(whole.vertices.size()),
                                  static_cast<long long>(whole.tets.size()),
                                  static_cast<long long>(whole.triangles.size())};
  Teuchos::broadcast(*comm, 0, 3, counts.data());
  const auto [vertices, tets, triangles] = counts;
  const bool is_root = comm->getRank() == 0;
  const auto rows_of = [&](const auto& rows, long long total) {
    using All = std::decay_t<decltype(rows)>;
    return spread(*comm, is_root ? rows : All{}, 0, total);
  };
  Slab slab{comm, {}, vertices, tets, triangles};
  slab.rows.vertices = rows_of(whole.vertices, vertices);
  slab.rows.tets = rows_of(whole.tets, tets);
  slab.rows.tet_region = rows_of(whole.tet_region, tets);
  slab.rows.triangles = rows_of(whole.triangles, triangles);
  slab.rows.triangle_surface = rows_of(whole.triangle_surface, triangles);
  std::vector<std::string> names;
  for (const TetVectors& vectors : whole.tet_vectors) names.push_back(vectors.name);
  broadcast(*comm, names);
  for (std::size_t k = 0; k < names.size(); ++k) {
    static const std::vector<Vec3> none;
    const auto& values = is_root ? whole.tet_vectors[k].values : none;
    slab.rows.tet_vectors.push_back({names[k], rows_of(values, tets)});
  }
  if (is_root) {
    slab.rows.regions = whole.regions;
    slab.rows.surfaces = whole.surfaces;
  }
  broadcast(*comm, slab.rows.regions);
  broadcast(*comm, slab.rows.surfaces);
  return slab;
}

Mesh gathered(const Slab& slab) {
  const Comm& comm = *slab.comm;
  TUNICA_CHECK(slab.tets < std::numeric_limits<int>::max(),
               "a mesh of " + std::to_string(slab.tets) + " tetrahedra, more than a rank can have");
  Mesh whole;
  whole.regions = slab.rows.regions;
  whole.surfaces = slab.rows.surfaces;
  whole.vertices = gather_rows(comm, slab.rows.vertices);
  whole.tets = gather_rows(comm, slab.rows.tets);
  whole.tet_region = gather_rows(comm, slab.rows.tet_region);
  whole.triangles = gather_rows(comm, slab.rows.triangles);
  whole.triangle_surface = gather_rows(comm, slab.rows.triangle_surface);
  for (const TetVectors& vectors : slab.rows.tet_vectors)
    whole.tet_vectors.push_back({vectors.name, gather_rows(comm, vectors.values)});
  return whole;
}

Slab read_slab(const std::string& path, const CommPtr& comm) {
  bool is_own = false;
  on_root(*comm, [&] { is_own = is_hdf5(path); });
  int answer = is_own ? 1 : 0;
  Teuchos::broadcast(*comm, 0, 1, &answer);
  Slab slab = answer == 1 ? read_own(path, comm) : read_text_mesh(path, comm);
  on_all(*comm, [&] {
    TUNICA_CHECK(slab.tets > 0, path + ": the mesh has no tetrahedra");
    TUNICA_CHECK(slab.vertices > 0, path + ": the mesh has no vertices");
    check_tags(slab.rows, path);
    check_rows(slab.rows, slab.place(), path);
  });
  return slab;
}

namespace {

/// That its file takes, and some for its head.
long long bytes_of(const Slab& slab) {
  const auto fields = static_cast<long long>(slab.rows.tet_vectors.size());
  const auto regions = static_cast<long long>(slab.rows.regions.size());
  const auto surfaces = static_cast<long long>(slab.rows.surfaces.size());
  return 24 * slab.vertices + (20 + 24 * fields) * slab.tets + 16 * slab.triangles +
         4096 * (regions + surfaces) + (1 << 20);
}

void write_rows(const Slab& slab, io::Hdf5File& file) {
  const Place place = slab.place();
  const Mesh& mesh = slab.rows;
  const auto rows = [](long long total, long long first, std::size_t count, int columns) {
    return io::Hdf5File::Rows{total, first, static_cast<long long>(count), columns};
  };
  file.write("vertices", rows(slab.vertices, place.first_vertex, mesh.vertices.size(), 3),
             reinterpret_cast<const double*>(mesh.vertices.data()));
  file.write("tets", rows(slab.tets, place.first_tet, mesh.tets.size(), 4),
             reinterpret_cast<const int*>(mesh.tets.data()));
  file.write("tet_region", rows(slab.tets, place.first_tet, mesh.tets.size(), 1),
             mesh.tet_region.data());
  file.write("triangles", rows(slab.triangles, place.first_triangle, mesh.triangles.size(), 3),
             reinterpret_cast<const int*>(mesh.triangles.data()));
  file.write("triangle_surface",
             rows(slab.triangles, place.first_triangle, mesh.triangles.size(), 1),
             mesh.triangle_surface.data());
}

/// kind: "region" or "surface". Rank 0 has the numbers.
void write_tags(const std::vector<Tag>& tags, const std::string& kind, bool is_root,
                io::Hdf5File& file) {
  std::vector<int> ids;
  std::vector<std::string> names;
  for (const Tag& tag : tags) {
    ids.push_back(tag.id);
    names.push_back(tag.name);
  }
  const auto n = static_cast<long long>(ids.size());
  file.write(kind + "_ids", {n, 0, is_root ? n : 0, 1}, ids.data());
  file.write(kind + "_names", names);
}

void write_tet_vectors(const Slab& slab, io::Hdf5File& file) {
  const Mesh& mesh = slab.rows;
  const Place place = slab.place();
  std::vector<std::string> names;
  for (const TetVectors& vectors : mesh.tet_vectors) names.push_back(vectors.name);
  file.write("tet_vector_names", names);
  std::vector<io::Hdf5File::Part> parts;
  const auto fields = static_cast<long long>(names.size());
  for (long long k = 0; k < fields; ++k)
    parts.push_back({k * slab.tets + place.first_tet, static_cast<long long>(mesh.tets.size()),
                     reinterpret_cast<const double*>(mesh.tet_vectors[k].values.data())});
  file.write("tet_vectors", fields * slab.tets, 3, parts);
}

}  // namespace

void write_slab(const Slab& slab, const std::string& path) {
  const CommPtr& comm = slab.comm;
  const Mesh& mesh = slab.rows;
  const bool is_root = comm->getRank() == 0;
  io::AtomicFile named(path);  // removes the draft where it does not come to its name
  const std::string draft = io::AtomicFile::draft_of(path);
  io::Hdf5File(draft, io::Hdf5File::Mode::create, 0, comm).close();
  io::Hdf5File file(draft, io::Hdf5File::Mode::extend, bytes_of(slab), comm);
  file.attribute("/", "format", std::string(hdf5_format));
  write_rows(slab, file);
  write_tags(mesh.regions, "region", is_root, file);
  write_tags(mesh.surfaces, "surface", is_root, file);
  if (!mesh.tet_vectors.empty()) write_tet_vectors(slab, file);
  file.close();
  on_root_or_fault(*comm, [&] { return named.commit_to_disk(); });
}

Vec3 extent(const Slab& slab) {
  constexpr double far = std::numeric_limits<double>::max();
  Vec3 low{far, far, far}, high{-far, -far, -far};
  for (const Vec3& x : slab.rows.vertices)
    for (int i = 0; i < 3; ++i) {
      low[i] = std::min(low[i], x[i]);
      high[i] = std::max(high[i], x[i]);
    }
  Vec3 lengths{};
  for (int i = 0; i < 3; ++i)
    lengths[i] = global_max(*slab.comm, high[i]) - global_min(*slab.comm, low[i]);
  return lengths;
}

std::string fingerprint(const Slab& slab) {
  const Place place = slab.place();
  std::uint64_t mine = 0, sum = 0;  // of the rows' hashes: in any order the same
  add_rows(mine, 'v', place.first_vertex, slab.rows.vertices);
  add_rows(mine, 't', place.first_tet, slab.rows.tets);
  add_rows(mine, 'r', place.first_tet, slab.rows.tet_region);
  add_rows(mine, 'f', place.first_triangle, slab.rows.triangles);
  add_rows(mine, 's', place.first_triangle, slab.rows.triangle_surface);
  if (slab.comm->getRank() == 0) {
    add_names(mine, 'R', slab.rows.regions);
    add_names(mine, 'S', slab.rows.surfaces);
  }
  for (const TetVectors& vectors : slab.rows.tet_vectors) {
    const std::uint64_t name = hash_bytes(vectors.name.data(), vectors.name.size());
    std::uint64_t values = 0;
    add_rows(values, 'd', place.first_tet, vectors.values);
    mine += values * (2 * name + 1);
  }
  MPI_Allreduce(&mine, &sum, 1, MPI_UINT64_T, MPI_SUM, mpi_comm(*slab.comm));
  return hash_digits(sum);
}

std::vector<char> vertex_fields(const Slab& slab, const std::vector<bool>& region_is_fluid,
                                const std::string& name) {
  const Comm& comm = *slab.comm;
  const std::vector<int> used = vertices_of(slab.rows.tets);
  std::vector<char> fields(used.size(), 0);
  for (std::size_t t = 0; t < slab.rows.tets.size(); ++t)
    for (const int v : slab.rows.tets[t])
      fields[place_of(v, used)] |= region_is_fluid[slab.rows.tet_region[t]] ? in_fluid : in_wall;
  const std::vector<int> counts = rows_by_rank(comm, used, slab.vertices);
  const std::vector<int> there = exchange(comm, used, counts).items;
  const std::vector<char> found = exchange(comm, fields, counts).items;
  const long long first = slab.place().first_vertex;
  std::vector<char> mine(slab.rows.vertices.size(), 0);
  for (std::size_t k = 0; k < there.size(); ++k) mine[there[k] - first] |= found[k];
  on_all(comm, [&] { check_use(mine, slab.rows.vertices, first, name); });
  return mine;
}

}  // namespace tunica::mesh
