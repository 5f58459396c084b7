#pragma once
#include <deque>
#include <memory>
#include <vector>

#include "tunica/multigrid/coarsening/rigid_interpolation.hpp"

namespace tunica::multigrid {

/// Coarser and coarser sets of nodes, picked from a graph of nodes [Ki98]: a maximal
/// independent set becomes the next level, and every other node takes the mean of its
/// neighbours in it (one between fields: of such neighbours alone). Where nearly half of the nodes
/// would stay, neighbours of neighbours count as neighbours. Nodes without neighbours (fixed
/// ones, in systems that keep only their diagonals) are left out of coarser levels. Depends on the
/// graph, the order and the nodes between fields alone; made level by level as they are asked for.
///
/// Nodes that have hosts among those of another coarsening, as pressures that jump have their
/// vertices, follow it: where the host stays in the next level they do, and others only join them.
/// One with the number of its host keeps it so; the rest is numbered behind all hosts.
class NodalCoarsening {
public:
  /// nodes: square, with one row per node and an entry on the diagonal.
  /// order: in which nodes are picked, a number per node, none twice. With numbers that do not hang
  /// on the ranks the coarse nodes do not either.
  /// between: 1 at nodes where fields of different stiffness meet, 0 elsewhere; null: nowhere. They
  /// are picked first, and those that are left have their parents among themselves: one with a
  /// parent in the softer field would bend the stiffer with it.
  /// places: of nodes of solids, whose rotations rigid() interpolates.
  /// vectors: of scalars, the coarsening of the vectors, at nodes of their own: neighbours of
  /// neighbours count where they do there, so that there are always some vectors for each scalar.
  /// is_plane: nodes of a plane mesh, of whose finest level those with fewest neighbours come
  /// first.
  NodalCoarsening(const Teuchos::RCP<const CrsGraph>& nodes, const Vector& order,
                  const Teuchos::RCP<const Vector>& between = Teuchos::null,
                  const algebra::NodePlaces& places = {},
                  std::shared_ptr<NodalCoarsening> vectors = nullptr, bool is_plane = false);
  /// hosts: for each node the number of its host on the same rank, or -1. No two nodes with the
  /// same host may be neighbours, and nodes only where their hosts are.
  NodalCoarsening(const Teuchos::RCP<const CrsGraph>& nodes, const Vector& order,
                  const Vector& hosts, std::shared_ptr<NodalCoarsening> leader);

  /// Interpolation from level + 1 to level (0 the finest). Its rows sum to one, but for
  /// nodes left out. Collective where it is asked for the first time.
  Teuchos::RCP<const CrsMatrix> prolongator(int level) { return at(level).P; }

  /// Interpolation of displacements that is exact for rigid motions; null where no places are
  /// known. It is large, needed for one matrix and not kept: made at each call. Collective.
  std::shared_ptr<const RigidInterpolation> rigid(int level);

  /// The numbers of the hosts on this level, -1 for none; null without leader. Collective as
  /// prolongator() is.
  Teuchos::RCP<const Vector> hosts(int level);

  /// The local row on this level of each local node of the next. Collective as prolongator() is.
  const std::vector<int>& coarse_rows(int level) { return at(level).coarse_rows; }

  /// Whether neighbours of neighbours count there. Collective as prolongator() is.
  bool is_wide(int level) { return at(level).is_wide; }

  /// flatness_of_solids of the finest level.
  double flatness() const { return flatness_; }

private:
  struct Level {
    Teuchos::RCP<const CrsGraph> nodes;  ///< without places null once the next level is made
    Teuchos::RCP<const Vector> order;
    Teuchos::RCP<const Vector> hosts;    ///< numbers on this level; null without leader
    Teuchos::RCP<const Vector> between;  ///< null: no nodes
    algebra::NodePlaces places{};
    Teuchos::RCP<const CrsMatrix> P{};     ///< from the next level; null where it is not made yet
    Teuchos::RCP<const Vector> numbers{};  ///< on the next level, -1 where it lacks the node
    std::vector<int> coarse_rows{};
    bool is_wide = false;
  };

  const Level& at(int level);
  /// Those that become nodes of the next level, those first of which the vector has another value.
  std::vector<char> chosen_nodes(const CrsGraph& nodes, const Level& level,
                                 const Teuchos::RCP<const Vector>& first, double value) const;
  void coarsen();
  Vector numbers_of_hosts(int level);

  std::shared_ptr<NodalCoarsening> leader_, vectors_;
  bool is_plane_ = false;
  std::deque<Level> levels_;
  double flatness_ = 1.0;
};

}  // namespace tunica::multigrid
