#include "tunica/fields/interface_transfer.hpp"

#include <Teuchos_CommHelpers.hpp>
#include <unordered_map>

#include "tunica/base/error.hpp"

namespace tunica::fields {

namespace {

std::vector<Vec3> spread(const InterfaceVector& values, const std::vector<int>& nodes, int count) {
  std::vector<Vec3> field(count);
  for (std::size_t k = 0; k < nodes.size(); ++k)
    field[nodes[k]] = {values[3 * k], values[3 * k + 1], values[3 * k + 2]};
  return field;
}

InterfaceVector collect(const std::vector<Vec3>& field, const std::vector<int>& nodes) {
  InterfaceVector values;
  values.reserve(3 * nodes.size());
  for (const int a : nodes) values.insert(values.end(), field[a].begin(), field[a].end());
  return values;
}

}  // namespace

InterfaceTransfer::InterfaceTransfer(const FieldMesh& fluid, const FieldMesh& wall,
                                     const std::vector<int>& shared_surfaces)
    : surfaces(shared_surfaces), n_fluid_(fluid.n_owned), n_wall_(wall.n_owned) {
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

std::vector<Vec3> InterfaceTransfer::to_fluid(const InterfaceVector& values) const {
  return spread(values, fluid_nodes, n_fluid_);
}

std::vector<Vec3> InterfaceTransfer::to_wall(const InterfaceVector& values) const {
  return spread(values, wall_nodes, n_wall_);
}

InterfaceVector InterfaceTransfer::from_fluid(const std::vector<Vec3>& values) const {
  return collect(values, fluid_nodes);
}

InterfaceVector InterfaceTransfer::from_wall(const std::vector<Vec3>& values) const {
  return collect(values, wall_nodes);
}

}  // namespace tunica::fields
