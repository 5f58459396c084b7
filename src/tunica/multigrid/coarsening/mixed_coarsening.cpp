#include "tunica/multigrid/coarsening/mixed_coarsening.hpp"

#include <algorithm>
#include <stdexcept>

#include "tunica/algebra/independent_set.hpp"
#include "tunica/algebra/picked_matrix.hpp"
#include "tunica/algebra/static_matrix.hpp"
#include "tunica/base/agreement.hpp"
#include "tunica/base/map_of.hpp"
#include "tunica/base/reduce.hpp"
#include "tunica/base/trilinos.hpp"

namespace tunica::multigrid {

namespace {

/// Takes a prolongator of nodes to the unknowns stride*node + first + i, i < count. A coarse node
/// has those that it has on the finer level.
class Expansion {
public:
  Expansion(NodalCoarsening& nodes, int level, int stride, int first, int count, const Map& fine)
      : nodes_(&nodes), level_(level), P_(nodes.prolongator(level)), stride_(stride), first_(first),
        count_(count) {
    // Bit i of a node's number says that it has unknown i. As numbers these travel to the coarse
    // nodes and to the ghosts among the columns of P.
    Vector owns(P_->getRowMap()), coarse_owns(P_->getDomainMap());
    const auto has = owns.getLocalViewHost(read_write);
    for (std::size_t a = 0; a < has.extent(0); ++a)
      for (int i = 0; i < count; ++i)
        if (fine.isNodeGlobalElement(number(P_->getRowMap()->getGlobalElement(a), i)))
          has(a, 0) += 1 << i;
    const std::vector<int>& rows = nodes.coarse_rows(level);
    const auto coarse_has = coarse_owns.getLocalViewHost(overwrite_all);
    for (std::size_t c = 0; c < rows.size(); ++c) coarse_has(c, 0) = has(rows[c], 0);
    fine_ = flags(owns);
    coarse_ = flags(coarse_owns);
    columns_ = flags(algebra::on_columns(*P_, coarse_owns));
  }

  /// For vectors of three components at all coarse nodes. Collective.
  void use_rotations() {
    const bool are_whole =
        std::all_of(coarse_.begin(), coarse_.end(), [](int has) { return has == 7; });
    if (count_ == 3 && all_agree(*P_->getComm(), are_whole)) rigid_ = nodes_->rigid(level_);
  }

  /// Of the rows of the fine map that are its own.
  void count_entries(const Map& fine, std::vector<std::size_t>& counts) const {
    const auto local = P_->getLocalMatrixHost();
    for (int a = 0; a < local.numRows(); ++a) {
      const auto n = turns(a) ? 3 * (rigid_->start[a + 1] - rigid_->start[a])
                              : static_cast<std::size_t>(local.rowConst(a).length);
      for (int i = 0; i < count_; ++i)
        if (fine_[a] >> i & 1)
          counts[fine.getLocalElement(number(P_->getRowMap()->getGlobalElement(a), i))] = n;
    }
  }

  void append_coarse(std::vector<GlobalOrdinal>& numbers) const {
    for (std::size_t c = 0; c < coarse_.size(); ++c)
      for (int i = 0; i < count_; ++i)
        if (coarse_[c] >> i & 1)
          numbers.push_back(number(P_->getDomainMap()->getGlobalElement(c), i));
  }

  void add_to(algebra::EntryRows& entries, const Map& fine) const {
    const auto local = P_->getLocalMatrixHost();
    std::vector<GlobalOrdinal> parents;
    // u_i = Σ_k B_ik u_k with blocks of 3×3 where rotations are interpolated; else each unknown is
    // the mean of the parents that have it, so that rows sum to one
    for (int a = 0; a < local.numRows(); ++a) {
      if (turns(a)) {
        add_rigid(a, entries, fine);
        continue;
      }
      for (int i = 0; i < count_; ++i) {
        if (!(fine_[a] >> i & 1)) continue;
        parents.clear();
        const auto row = local.rowConst(a);
        for (int k = 0; k < row.length; ++k)
          if (columns_[row.colidx(k)] >> i & 1)
            parents.push_back(number(P_->getColMap()->getGlobalElement(row.colidx(k)), i));
        const auto own = fine.getLocalElement(number(P_->getRowMap()->getGlobalElement(a), i));
        for (const GlobalOrdinal parent : parents)
          entries.add(own, parent, 1.0 / static_cast<double>(parents.size()));
      }
    }
  }

private:
  /// Its displacements follow rotations.
  bool turns(int a) const { return rigid_ != nullptr && fine_[a] == 7 && rigid_->has(a); }

  // The three rows of a node from its blocks, each with the components of all coarse nodes k.
  void add_rigid(int a, algebra::EntryRows& entries, const Map& fine) const {
    const GlobalOrdinal node = P_->getRowMap()->getGlobalElement(a);
    for (int i = 0; i < 3; ++i) {
      const auto own = fine.getLocalElement(number(node, i));
      for (std::size_t k = rigid_->start[a]; k < rigid_->start[a + 1]; ++k)
        for (int j = 0; j < 3; ++j)
          entries.add(own, number(rigid_->nodes[k], j), rigid_->blocks[k][i][j]);
    }
  }

  GlobalOrdinal number(GlobalOrdinal node, int i) const { return stride_ * node + first_ + i; }

  static std::vector<int> flags(const Vector& v) {
    const auto values = v.getLocalViewHost(read_only);
    std::vector<int> all(values.extent(0));
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = static_cast<int>(values(i, 0));
    return all;
  }

  NodalCoarsening* nodes_;
  int level_;
  Teuchos::RCP<const CrsMatrix> P_;
  int stride_, first_, count_;
  std::shared_ptr<const RigidInterpolation> rigid_;  ///< null: none turns
  std::vector<int> fine_, coarse_, columns_;         ///< bit i: the node has unknown i
};

/// Flags of the nodes between the parts of a coupled system, which its space names last.
Teuchos::RCP<const Vector> between(const algebra::Nodes& nodes,
                                   const std::vector<std::string>& parts) {
  if (nodes.parts.is_null()) return Teuchos::null;
  const auto flags = Teuchos::rcp(new Vector(nodes.parts->getMap()));
  const auto part = nodes.parts->getLocalViewHost(read_only);
  const auto flag = flags->getLocalViewHost(overwrite_all);
  for (std::size_t a = 0; a < flag.extent(0); ++a)
    flag(a, 0) = part(a, 0) == static_cast<double>(parts.size() - 1) ? 1.0 : 0.0;
  return flags;
}

}  // namespace

// Blocks on one graph share their coarsening, so that a node that stays keeps all its unknowns.
// Nodes with hosts follow the coarsening of the first block.
MixedCoarsening::MixedCoarsening(const algebra::BlockSpace& space)
    : numbering_(space), part_names_(space.parts()), parts_(1) {
  for (int b = 0; b < space.n_blocks(); ++b) {
    const algebra::Nodes& nodes = space[b].nodes;
    for (int c = 0; c < b && static_cast<int>(nodes_.size()) == b; ++c)
      if (space[c].nodes.graph == nodes.graph) nodes_.push_back(nodes_[c]);
    if (static_cast<int>(nodes_.size()) == b)
      nodes_.push_back(nodes.hosts.is_null()
                           ? std::make_shared<NodalCoarsening>(
                                 nodes.graph, *nodes.order, between(nodes, part_names_),
                                 nodes.places, b > 0 ? nodes_.front() : nullptr,
                                 b == 0 && space[b].components == 2)
                           : std::make_shared<NodalCoarsening>(nodes.graph, *nodes.order,
                                                               *nodes.hosts, nodes_.front()));
    maps_[{0, b}] = space[b].map;
    parts_[0].push_back(nodes.parts);
  }
  maps_[{0, all}] = numbering_.merged_map(space);
}

Teuchos::RCP<const CrsMatrix> MixedCoarsening::prolongator(int level, const Map& rows,
                                                           bool has_rotations) {
  return prolongator(level, block_of(level, rows), has_rotations);
}

int MixedCoarsening::block_of(int level, const Map& rows) {
  // A matrix is recognised by its rows: lists name no blocks.
  std::vector<int> found;  // blocks on different nodes may have as many rows
  for (int b = all; b < numbering_.n_blocks(); ++b) {
    if (map(level, b)->getGlobalNumElements() != rows.getGlobalNumElements()) continue;
    if (map(level, b)->isSameAs(rows)) return b;  // before the maps of further blocks are made
    found.push_back(b);
  }
  if (found.size() == 1) return found.front();
  throw std::runtime_error("NodalPFactory: no block has these " +
                           std::to_string(rows.getGlobalNumElements()) + " rows on level " +
                           std::to_string(level) + ".");
}

// Followers, where there are any, are the nodes of the last block.
Teuchos::RCP<const Vector> MixedCoarsening::hosts(int level, const CrsMatrix& K) {
  const Teuchos::RCP<const Vector> hosts = nodes_.back()->hosts(level);
  if (hosts.is_null() || map(level, all)->getGlobalNumElements() != K.getGlobalNumRows())
    return Teuchos::null;
  return hosts;
}

Vector MixedCoarsening::parts(int level, const CrsMatrix& K) {
  if (part_names_.empty()) throw std::runtime_error("the system has no parts");
  if (!map(level, all)->isSameAs(*K.getRowMap()))
    throw std::runtime_error("parts are known on levels of NodalPFactory alone");
  for (int l = static_cast<int>(parts_.size()); l <= level; ++l) {
    parts_.emplace_back();
    for (int b = 0; b < numbering_.n_blocks(); ++b) {  // a coarse node is one of the finer level
      const auto coarse = Teuchos::rcp(new Vector(nodes_[b]->prolongator(l - 1)->getDomainMap()));
      algebra::pick_rows(nodes_[b]->coarse_rows(l - 1), *parts_[l - 1][b], *coarse);
      parts_[l].push_back(coarse);
    }
  }
  // A row is in the part of its node.
  Vector result(K.getRowMap());
  const auto part = result.getLocalViewHost(overwrite_all);
  for (std::size_t r = 0; r < part.extent(0); ++r) {
    const GlobalOrdinal number = K.getRowMap()->getGlobalElement(static_cast<int>(r));
    const Vector& nodes = *parts_[level][numbering_.block_of(number)];
    part(r, 0) = nodes.getLocalViewHost(read_only)(
        nodes.getMap()->getLocalElement(number / numbering_.dofs()), 0);
  }
  return result;
}

void MixedCoarsening::check_mixed(int level, const CrsMatrix& K) {
  const auto has_rows_of = [&](int block) {
    return map(level, block)->getGlobalNumElements() == K.getGlobalNumRows();
  };
  if (has_rows_of(all)) return;
  const Map& rows = *K.getRowMap();
  const std::size_t n = n_local(rows), dofs = numbering_.dofs();
  // Whole nodes are as good where another coarsening made the level.
  bool is_block = false;
  for (int b = 0; b < numbering_.n_blocks(); ++b) is_block |= has_rows_of(b);  // collective
  bool is_mixed = n % dofs == 0 && !is_block;
  for (std::size_t i = 0; is_mixed && i < n; ++i)
    is_mixed = rows.getGlobalElement(static_cast<int>(i)) % numbering_.dofs() ==
               static_cast<GlobalOrdinal>(i % dofs);
  throw_if_any<std::runtime_error>(
      *rows.getComm(), is_mixed ? ""
                                : "a smoother for mixed matrices needs one with " +
                                      std::to_string(dofs) + " unknowns per node, the scalar last");
}

// The unknowns of a level are the columns of any prolongator that leads to it.
const Teuchos::RCP<const Map>& MixedCoarsening::map(int level, int block) {
  if (maps_.count({level, block}) == 0) prolongator(level - 1, block);
  return maps_.at({level, block});
}

// P of one block, or of all blocks in one matrix: there the rows and columns of block b have the
// numbers dofs·node + first_b + i, so that P is block-diagonal with the nodes' unknowns
// interleaved.
Teuchos::RCP<const CrsMatrix> MixedCoarsening::prolongator(int level, int block,
                                                           bool has_rotations) {
  const auto found = prolongators_.find({level, block, has_rotations});
  if (found != prolongators_.end()) return found->second;
  const Teuchos::RCP<const Map> fine = map(level, block);
  std::vector<Expansion> expansions;
  if (block == all) {
    int first = 0;
    for (int b = 0; b < numbering_.n_blocks(); first += numbering_.components(b++))
      expansions.emplace_back(*nodes_[b], level, numbering_.dofs(), first, numbering_.components(b),
                              *fine);
  } else {
    const int components = numbering_.components(block);
    expansions.emplace_back(*nodes_[block], level, components, 0, components, *fine);
  }
  if (has_rotations)
    for (Expansion& expansion : expansions) expansion.use_rotations();
  std::vector<GlobalOrdinal> numbers;
  std::vector<std::size_t> counts(n_local(*fine), 0);
  for (const Expansion& expansion : expansions) {
    expansion.append_coarse(numbers);
    expansion.count_entries(*fine, counts);
  }
  // Ascending, the unknowns of a node stand side by side on the next level, too.
  std::sort(numbers.begin(), numbers.end());
  const Teuchos::RCP<const Map> coarse = map_of(numbers, fine->getComm());
  algebra::EntryRows entries(counts);
  for (const Expansion& expansion : expansions) expansion.add_to(entries, *fine);
  const Teuchos::RCP<const CrsMatrix> P = entries.take(fine, coarse);
  maps_[{level + 1, block}] = coarse;
  return prolongators_[{level, block, has_rotations}] = P;
}

}  // namespace tunica::multigrid
