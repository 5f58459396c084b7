#include "tunica/fields/broadcast_mesh.hpp"

#include <Teuchos_CommHelpers.hpp>

#include "tunica/base/agreement.hpp"

namespace tunica::fields {

namespace {

/// Broadcasts numbers, or arrays of numbers, of any length.
template <class Number, class Item>
void broadcast_items(const Comm& comm, std::vector<Item>& items) {
  long long count = static_cast<long long>(items.size());
  Teuchos::broadcast(comm, 0, 1, &count);
  items.resize(count);
  constexpr std::size_t width = sizeof(Item) / sizeof(Number);
  constexpr std::size_t chunk = std::size_t{1} << 24;  // counts in MPI are 32 bit
  auto* numbers = reinterpret_cast<Number*>(items.data());
  for (std::size_t first = 0; first < width * items.size(); first += chunk)
    Teuchos::broadcast(comm, 0, static_cast<int>(std::min(chunk, width * items.size() - first)),
                       numbers + first);
}

void broadcast_tags(const Comm& comm, std::vector<mesh::Tag>& tags) {
  int count = static_cast<int>(tags.size());
  Teuchos::broadcast(comm, 0, 1, &count);
  tags.resize(count);
  for (mesh::Tag& tag : tags) {
    Teuchos::broadcast(comm, 0, 1, &tag.id);
    broadcast(comm, tag.name);
  }
}

void broadcast_vectors(const Comm& comm, std::vector<mesh::TetVectors>& all) {
  int count = static_cast<int>(all.size());
  Teuchos::broadcast(comm, 0, 1, &count);
  all.resize(count);
  for (mesh::TetVectors& vectors : all) {
    broadcast(comm, vectors.name);
    broadcast_items<double>(comm, vectors.values);
  }
}

}  // namespace

void broadcast_mesh(const Comm& comm, mesh::Mesh& mesh) {
  broadcast_items<double>(comm, mesh.vertices);
  broadcast_items<int>(comm, mesh.tets);
  broadcast_items<int>(comm, mesh.tet_region);
  broadcast_items<int>(comm, mesh.triangles);
  broadcast_items<int>(comm, mesh.triangle_surface);
  broadcast_tags(comm, mesh.regions);
  broadcast_tags(comm, mesh.surfaces);
  broadcast_vectors(comm, mesh.tet_vectors);
}

}  // namespace tunica::fields
