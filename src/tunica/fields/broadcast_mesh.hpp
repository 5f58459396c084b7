#pragma once
#include "tunica/base/types.hpp"
#include "tunica/mesh/mesh.hpp"

namespace tunica::fields {

/// Gives every rank the mesh of rank 0. Every rank then holds the whole mesh until it has
/// taken its share. Collective.
void broadcast_mesh(const Comm& comm, mesh::Mesh& mesh);

}  // namespace tunica::fields
