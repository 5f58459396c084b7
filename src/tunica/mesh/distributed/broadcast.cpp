#include "tunica/mesh/distributed/broadcast.hpp"

#include <Teuchos_CommHelpers.hpp>

#include "tunica/base/agreement.hpp"

namespace tunica::mesh {

void broadcast(const Comm& comm, std::vector<Tag>& tags) {
  int count = static_cast<int>(tags.size());
  Teuchos::broadcast(comm, 0, 1, &count);
  tags.resize(count);
  for (Tag& tag : tags) {
    Teuchos::broadcast(comm, 0, 1, &tag.id);
    tunica::broadcast(comm, tag.name);
  }
}

void broadcast(const Comm& comm, std::vector<std::string>& names) {
  int count = static_cast<int>(names.size());
  Teuchos::broadcast(comm, 0, 1, &count);
  names.resize(count);
  for (std::string& name : names) tunica::broadcast(comm, name);
}

}  // namespace tunica::mesh
