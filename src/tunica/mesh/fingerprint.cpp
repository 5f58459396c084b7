#include "tunica/mesh/fingerprint.hpp"

#include "tunica/base/hash.hpp"

namespace tunica::mesh {

namespace {

template <class Item>
std::uint64_t added(std::uint64_t hash, const std::vector<Item>& items) {
  const std::size_t count = items.size();
  hash = hash_bytes(&count, sizeof count, hash);
  return hash_bytes(items.data(), count * sizeof(Item), hash);
}

}  // namespace

std::string fingerprint(const Mesh& mesh) {
  std::uint64_t hash = added(hash_start, mesh.vertices);
  hash = added(hash, mesh.tets);
  hash = added(hash, mesh.tet_region);
  hash = added(hash, mesh.triangles);
  hash = added(hash, mesh.triangle_surface);
  for (const TetVectors& vectors : mesh.tet_vectors) {
    hash = hash_bytes(vectors.name.data(), vectors.name.size(), hash);
    hash = added(hash, vectors.values);
  }
  return hash_digits(hash);
}

}  // namespace tunica::mesh
