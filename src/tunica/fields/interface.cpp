#include "tunica/fields/interface.hpp"

#include <Teuchos_CommHelpers.hpp>
#include <unordered_map>

#include "tunica/base/error.hpp"

namespace tunica::fields {

Interface::Interface(const FieldMesh& fluid, const FieldMesh& wall,
                     const std::vector<int>& shared_surfaces)
    : surfaces(shared_surfaces) {
  std::unordered_map<int, int> wall_node_of;
  for (int a = 0; a < wall.n_owned; ++a) wall_node_of[wall.vertex[a]] = a;
  for (int a = 0; a < fluid.n_owned; ++a) {
    if (!fluid.is_on_any(a, surfaces)) continue;
    const auto found = wall_node_of.find(fluid.vertex[a]);
    TUNICA_ASSERT(found != wall_node_of.end(), "the mesh check lets only conforming pairs pass");
    fluid_nodes.push_back(a);
    wall_nodes.push_back(found->second);
  }
  const long long mine = n_owned();
  Teuchos::reduceAll(*fluid.comm, Teuchos::REDUCE_SUM, 1, &mine, &n_total_);
}

}  // namespace tunica::fields
