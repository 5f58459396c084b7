#include "tunica/mesh/formats/hdf5.hpp"

#include <limits>

#include "tunica/base/error.hpp"
#include "tunica/base/portion.hpp"
#include "tunica/io/hdf5_arrays.hpp"
#include "tunica/mesh/validate.hpp"

namespace tunica::mesh {
namespace {

/// The rows of one rank among some, and how many all have.
struct Rows : Portion {
  Rows(const io::Hdf5Reader& in, const std::string& dataset, hsize_t columns, int rank, int ranks)
      : Rows(static_cast<long long>(in.rows(dataset, columns)), rank, ranks) {}
  Rows(long long of_all, int rank, int ranks)
      : Portion(portion_of(of_all, rank, ranks)), total(of_all) {}
  long long total;
};

template <typename T, std::size_t N>
void read_rows(const io::Hdf5Reader& in, const std::string& dataset, const Rows& mine,
               std::vector<std::array<T, N>>& rows) {
  rows.resize(static_cast<std::size_t>(mine.count));
  in.read(dataset, N, static_cast<hsize_t>(mine.first), rows.size(),
          reinterpret_cast<T*>(rows.data()));
}

/// One number for each element.
std::vector<int> read_numbers(const io::Hdf5Reader& in, const std::string& dataset,
                              const Rows& mine, const std::string& elements,
                              const std::string& path) {
  TUNICA_CHECK(static_cast<long long>(in.rows(dataset)) == mine.total,
               path + ": dataset /" + dataset + " has " + std::to_string(in.rows(dataset)) +
                   " rows, expected " + std::to_string(mine.total) + " as in /" + elements);
  std::vector<int> numbers(static_cast<std::size_t>(mine.count));
  in.read(dataset, 1, static_cast<hsize_t>(mine.first), numbers.size(), numbers.data());
  return numbers;
}

std::vector<Tag> read_tags(const io::Hdf5Reader& in, const std::string& kind,
                           const std::string& path) {
  const std::vector<int> ids = in.integers(kind + "_ids");
  const std::vector<std::string> names = in.strings(kind + "_names");
  TUNICA_CHECK(ids.size() == names.size(),
               path + ": dataset /" + kind + "_names has " + std::to_string(names.size()) +
                   " names, expected " + std::to_string(ids.size()) + " as in /" + kind + "_ids");
  std::vector<Tag> tags;
  for (std::size_t i = 0; i < ids.size(); ++i) tags.push_back({ids[i], names[i]});
  return tags;
}

/// One field behind the other, a row per tetrahedron. Files without them are older or have none.
void read_tet_vectors(const io::Hdf5Reader& in, const std::string& path, Rows mine, Mesh& mesh) {
  if (!in.has("tet_vectors")) return;
  const std::vector<std::string> names = in.strings("tet_vector_names");
  const auto fields = static_cast<long long>(names.size());
  const auto found = static_cast<long long>(in.rows("tet_vectors", 3));
  TUNICA_CHECK(found == fields * mine.total,
               path + ": dataset /tet_vectors has " + std::to_string(found) + " rows, expected " +
                   std::to_string(fields) + " times " + std::to_string(mine.total) +
                   " as in /tet_vector_names and /tets");
  for (const std::string& name : names) {
    mesh.tet_vectors.push_back({name, {}});
    read_rows(in, "tet_vectors", mine, mesh.tet_vectors.back().values);
    mine.first += mine.total;
  }
}

void write_tet_vectors(io::Hdf5Writer& out, const std::vector<TetVectors>& all) {
  if (all.empty()) return;
  std::vector<std::string> names;
  std::vector<Vec3> rows;
  for (const TetVectors& vectors : all) {
    names.push_back(vectors.name);
    rows.insert(rows.end(), vectors.values.begin(), vectors.values.end());
  }
  out.write("tet_vector_names", names);
  out.write("tet_vectors", reinterpret_cast<const double*>(rows.data()), rows.size(), 3);
}

void write_tags(io::Hdf5Writer& out, const std::vector<Tag>& tags, const std::string& kind) {
  std::vector<int> ids;
  std::vector<std::string> names;
  for (const Tag& tag : tags) {
    ids.push_back(tag.id);
    names.push_back(tag.name);
  }
  out.write(kind + "_ids", ids.data(), ids.size());
  out.write(kind + "_names", names);
}

void check_format(const io::Hdf5Reader& in, const std::string& path) {
  const std::string found = in.attribute("format");
  TUNICA_CHECK(found == hdf5_format, path + ": attribute \"format\" is \"" + found +
                                         "\", expected \"" + hdf5_format + "\"");
}

}  // namespace

Hdf5Rows read_hdf5_rows(const std::string& path, int rank, int ranks) {
  const io::Hdf5Reader in(path);
  check_format(in, path);
  const Rows vertices(in, "vertices", 3, rank, ranks), tets(in, "tets", 4, rank, ranks),
      triangles(in, "triangles", 3, rank, ranks);
  constexpr int most = std::numeric_limits<int>::max();
  TUNICA_CHECK(vertices.total <= most, path + ": has " + std::to_string(vertices.total) +
                                           " vertices, more than can be numbered");
  TUNICA_CHECK(tets.count < most, path + ": " + std::to_string(tets.count) +
                                      " tetrahedra on a rank, more than can be numbered");
  Hdf5Rows found{{}, vertices.total, tets.total, triangles.total};
  Mesh& mesh = found.rows;
  read_rows(in, "vertices", vertices, mesh.vertices);
  read_rows(in, "tets", tets, mesh.tets);
  mesh.tet_region = read_numbers(in, "tet_region", tets, "tets", path);
  read_rows(in, "triangles", triangles, mesh.triangles);
  mesh.triangle_surface = read_numbers(in, "triangle_surface", triangles, "triangles", path);
  mesh.regions = read_tags(in, "region", path);
  mesh.surfaces = read_tags(in, "surface", path);
  read_tet_vectors(in, path, tets, mesh);
  return found;
}

Mesh read_hdf5(const std::string& path) {
  Mesh mesh = read_hdf5_rows(path, 0, 1).rows;
  validate(mesh, path);
  return mesh;
}

void write_hdf5(const Mesh& mesh, const std::string& path) {
  io::Hdf5Writer out(path);
  out.attribute("format", hdf5_format);
  out.write("vertices", reinterpret_cast<const double*>(mesh.vertices.data()), mesh.vertices.size(),
            3);
  out.write("tets", reinterpret_cast<const int*>(mesh.tets.data()), mesh.tets.size(), 4);
  out.write("tet_region", mesh.tet_region.data(), mesh.tet_region.size());
  out.write("triangles", reinterpret_cast<const int*>(mesh.triangles.data()), mesh.triangles.size(),
            3);
  out.write("triangle_surface", mesh.triangle_surface.data(), mesh.triangle_surface.size());
  write_tags(out, mesh.regions, "region");
  write_tags(out, mesh.surfaces, "surface");
  write_tet_vectors(out, mesh.tet_vectors);
  out.save();
}

}  // namespace tunica::mesh
