#pragma once
#include <string>
#include <vector>

#include "tunica/base/types.hpp"
#include "tunica/mesh/mesh.hpp"

namespace tunica::mesh {

/// Give every rank what rank 0 has. Collective.
void broadcast(const Comm& comm, std::vector<Tag>& tags);
void broadcast(const Comm& comm, std::vector<std::string>& names);

}  // namespace tunica::mesh
