#include "tunica/algebra/sub_system.hpp"

#include <algorithm>
#include <stdexcept>

namespace tunica::algebra {

namespace {

/// 1 where the node is in one of the parts.
Vector flags_of_nodes(const Vector& parts, const std::vector<bool>& has_part) {
  Vector flags(parts.getMap());
  const auto part = parts.getLocalViewHost(read_only);
  const auto flag = flags.getLocalViewHost(overwrite_all);
  for (std::size_t a = 0; a < part.extent(0); ++a)
    flag(a, 0) = has_part[static_cast<std::size_t>(part(a, 0))] ? 1.0 : 0.0;
  return flags;
}

/// The same for the unknowns of a block.
Vector flags_of_unknowns(const Block& block, const Vector& nodes) {
  Vector flags(block.map);
  const auto at_node = nodes.getLocalViewHost(read_only);
  const auto flag = flags.getLocalViewHost(overwrite_all);
  for (std::size_t r = 0; r < flag.extent(0); ++r) {
    const GlobalOrdinal number = block.map->getGlobalElement(static_cast<int>(r));
    flag(r, 0) = at_node(nodes.getMap()->getLocalElement(number / block.components), 0);
  }
  return flags;
}

Teuchos::RCP<const Vector> picked_values(const Vector& all, const Vector& flags) {
  const auto some = Teuchos::rcp(new Vector(flagged_map(flags)));
  pick_rows(flagged_rows(flags), all, *some);
  return some;
}

NodePlaces picked_places(const NodePlaces& all, const Vector& flags) {
  if (all.coordinates.is_null()) return {};
  const auto some = Teuchos::rcp(new MultiVector(flagged_map(flags), 3));
  pick_rows(flagged_rows(flags), *all.coordinates, *some);
  return {some, picked_values(*all.in_solid, flags)};
}

/// -1 for hosts that are not among the nodes.
void drop_missing_hosts(const Map& nodes, Vector& hosts) {
  const auto host = hosts.getLocalViewHost(read_write);
  for (std::size_t a = 0; a < host.extent(0); ++a)
    if (!nodes.isNodeGlobalElement(static_cast<GlobalOrdinal>(host(a, 0)))) host(a, 0) = -1.0;
}

/// leaders: where the hosts are; null for the first block.
Nodes picked_nodes(const Nodes& all, const Vector& flags, const Map* leaders) {
  Nodes nodes{picked_graph(*all.graph, flags, flags), picked_values(*all.order, flags)};
  nodes.places = picked_places(all.places, flags);
  if (all.hosts.is_null()) return nodes;
  const auto hosts = Teuchos::rcp_const_cast<Vector>(picked_values(*all.hosts, flags));
  drop_missing_hosts(*leaders, *hosts);
  nodes.hosts = hosts;
  return nodes;
}

}  // namespace

SubSystem::SubSystem(const BlockMatrix& K, const std::vector<std::string>& parts) : whole_(&K) {
  const BlockSpace& space = *K.space();
  std::vector<bool> has_part;
  for (const std::string& name : space.parts())
    has_part.push_back(std::find(parts.begin(), parts.end(), name) != parts.end());
  std::vector<Block> blocks;
  for (int b = 0; b < K.n_blocks(); ++b) {
    const Vector nodes = flags_of_nodes(*space[b].nodes.parts, has_part);
    unknowns_.push_back(flags_of_unknowns(space[b], nodes));
    rows_.push_back(flagged_rows(unknowns_[b]));
    int first = 0;  // block on these nodes
    while (space[first].nodes.graph != space[b].nodes.graph) ++first;
    blocks.push_back(
        {space[b].name, flagged_map(unknowns_[b]), space[b].components,
         first < b ? blocks[first].nodes
                   : picked_nodes(space[b].nodes, nodes,
                                  b == 0 ? nullptr : blocks[0].nodes.order->getMap().get())});
  }
  K_ = BlockMatrix(std::make_shared<const BlockSpace>(blocks));
  for (int i = 0; i < K.n_blocks(); ++i)
    for (int j = 0; j < K.n_blocks(); ++j) {
      picked_.emplace_back();
      if (K(i, j).is_null()) continue;
      picked_.back().emplace(*K(i, j), unknowns_[i], unknowns_[j]);
      K_.set(i, j, picked_.back()->matrix());
    }
}

void SubSystem::refresh() {
  for (int i = 0; i < K_.n_blocks(); ++i)
    for (int j = 0; j < K_.n_blocks(); ++j)
      if (!K_(i, j).is_null()) refresh_block(i, j, *(*whole_)(i, j));
}

void SubSystem::refresh_block(int row, int column, const CrsMatrix& values) {
  picked_[row * K_.n_blocks() + column]->refresh(values);
}

int SubSystem::block_with(const Map& map) const {
  for (int b = 0; b < K_.n_blocks(); ++b)
    if ((*whole_->space())[b].map->isSameAs(map)) return b;
  throw std::logic_error("SubSystem: the matrix is not one between blocks of the whole");
}

Teuchos::RCP<CrsMatrix> SubSystem::pick(const CrsMatrix& A) const {
  return PickedMatrix(A, unknowns_[block_with(*A.getRowMap())],
                      unknowns_[block_with(*A.getDomainMap())])
      .matrix();
}

void SubSystem::restrict(const BlockVector& x, BlockVector& part) const {
  for (int b = 0; b < K_.n_blocks(); ++b) pick_rows(rows_[b], x[b], part[b]);
}

void SubSystem::add(double factor, const BlockVector& part, BlockVector& x) const {
  for (int b = 0; b < K_.n_blocks(); ++b) add_rows(rows_[b], factor, part[b], x[b]);
}

}  // namespace tunica::algebra
