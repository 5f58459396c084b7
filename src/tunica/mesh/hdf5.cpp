#include "tunica/mesh/hdf5.hpp"

#include <algorithm>

#include "tunica/base/error.hpp"
#include "tunica/io/hdf5_arrays.hpp"
#include "tunica/mesh/validate.hpp"

namespace tunica::mesh {
namespace {

const std::string format = "tunica-mesh 1";

template <typename T, std::size_t N>
std::vector<std::array<T, N>> rows_of(const std::vector<T>& values) {
  std::vector<std::array<T, N>> rows(values.size() / N);
  for (std::size_t i = 0; i < values.size(); ++i) rows[i / N][i % N] = values[i];
  return rows;
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
void read_tet_vectors(const io::Hdf5Reader& in, const std::string& path, Mesh& mesh) {
  if (!in.has("tet_vectors")) return;
  const std::vector<std::string> names = in.strings("tet_vector_names");
  const auto rows = rows_of<double, 3>(in.reals("tet_vectors", 3));
  TUNICA_CHECK(rows.size() == names.size() * mesh.tets.size(),
               path + ": dataset /tet_vectors has " + std::to_string(rows.size()) +
                   " rows, expected " + std::to_string(names.size()) + " times " +
                   std::to_string(mesh.tets.size()) + " as in /tet_vector_names and /tets");
  for (std::size_t k = 0; k < names.size(); ++k) {
    const auto first = rows.begin() + static_cast<std::ptrdiff_t>(k * mesh.tets.size());
    mesh.tet_vectors.push_back(
        {names[k], {first, first + static_cast<std::ptrdiff_t>(mesh.tets.size())}});
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
  TUNICA_CHECK(found == format,
               path + ": attribute \"format\" is \"" + found + "\", expected \"" + format + "\"");
}

}  // namespace

Mesh read_hdf5(const std::string& path) {
  const io::Hdf5Reader in(path);
  check_format(in, path);
  Mesh mesh;
  mesh.vertices = rows_of<double, 3>(in.reals("vertices", 3));
  mesh.tets = rows_of<int, 4>(in.integers("tets", 4));
  mesh.tet_region = in.integers("tet_region");
  mesh.triangles = rows_of<int, 3>(in.integers("triangles", 3));
  mesh.triangle_surface = in.integers("triangle_surface");
  mesh.regions = read_tags(in, "region", path);
  mesh.surfaces = read_tags(in, "surface", path);
  read_tet_vectors(in, path, mesh);
  validate(mesh, path);
  return mesh;
}

std::optional<Partition> read_hdf5_partition(const std::string& path) {
  const io::Hdf5Reader in(path);
  check_format(in, path);
  if (!in.has("tet_part")) return std::nullopt;
  Partition partition{in.integers("tet_part"), in.integers("vertex_owner")};
  const std::size_t tets = in.integers("tet_region").size();
  const std::size_t vertices = in.reals("vertices", 3).size() / 3;
  TUNICA_CHECK(partition.tet_part.size() == tets && partition.vertex_owner.size() == vertices,
               path + ": datasets /tet_part and /vertex_owner do not have the mesh's size");
  for (const auto* parts : {&partition.tet_part, &partition.vertex_owner})
    TUNICA_CHECK(std::all_of(parts->begin(), parts->end(), [](int part) { return part >= 0; }),
                 path + ": datasets /tet_part and /vertex_owner must not be negative");
  return partition;
}

void write_hdf5(const Mesh& mesh, const std::string& path, const Partition* partition) {
  io::Hdf5Writer out(path);
  out.attribute("format", format);
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
  if (partition) {
    out.write("tet_part", partition->tet_part.data(), partition->tet_part.size());
    out.write("vertex_owner", partition->vertex_owner.data(), partition->vertex_owner.size());
  }
  out.save();
}

}  // namespace tunica::mesh
