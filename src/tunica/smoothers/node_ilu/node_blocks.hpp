#pragma once
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "tunica/algebra/dof_layout.hpp"
#include "tunica/smoothers/node_ilu/fill_graph.hpp"

namespace tunica::smoothers {

/// A mixed matrix as dense blocks of a node's rows and a node's columns, ordered for incomplete
/// factors: the nodes of this rank, then those of other ranks that its rows reach, with their rows.
/// Columns beyond those nodes are left out. Where a node lacks an unknown, its row and column are
/// those of the unit matrix. Nodes follow their hosts, and share their columns, so that factors
/// without fill have all that the unknowns of both have.
class NodeBlocks {
public:
  /// K must outlive the blocks and keep its graph. Collective.
  /// hosts: see NodeIluOptions.
  NodeBlocks(const CrsMatrix& K, const algebra::DofLayout& numbering,
             const Teuchos::RCP<const Vector>& hosts);
  NodeBlocks(const NodeBlocks&) = delete;
  NodeBlocks& operator=(const NodeBlocks&) = delete;

  int n_nodes() const { return graph_.n_rows(); }
  int n_own_nodes() const { return n_own_nodes_; }
  int width() const { return width_; }  ///< unknowns per node, at most
  /// Unknowns of each node: 1 if it has the last of them alone, otherwise width. For a node of
  /// another rank, those reached by rows of this rank; the values of read() for others are
  /// undefined.
  const std::vector<std::uint8_t>& unknowns() const { return unknowns_; }
  /// Graph of the nodes, with the diagonal.
  const RowGraph& graph() const { return graph_; }

  /// Fetches the present rows of other ranks. Before a round of read(). Collective.
  void refresh();
  /// The present blocks of a node, one after the other, each column by column.
  void read(int node, double* blocks);

  /// A node's number in the numbering of K.
  GlobalOrdinal number(int node) const { return numbers_[node]; }

  /// Places, width*node + i, of the unknowns that K has as rows, in their order.
  const std::vector<int>& place_of_row() const { return place_of_row_; }
  /// Places of other ranks' unknowns among the nodes, and what brings the values of their rows in
  /// this order; null where the rank is alone.
  const std::vector<int>& ghost_places() const { return ghost_places_; }
  const Teuchos::RCP<const Import>& ghost_import() const { return import_; }
  /// The rows of other ranks' unknowns in this order, with all their columns; null where the rank
  /// is alone. Places of these columns; -1 where they lead beyond the nodes.
  const Teuchos::RCP<CrsMatrix>& ghost_rows() const { return ghosts_; }
  const std::vector<int>& ghost_column_places() const { return other_.places; }
  /// Bytes beside those of K on this rank.
  double bytes() const;

private:
  using Nodes = std::unordered_map<GlobalOrdinal, int>;
  /// Where rows come from.
  struct Source {
    const CrsMatrix* matrix = nullptr;
    std::vector<int> places;  ///< of its local columns, -1 where left out
    const std::size_t* start = nullptr;
    const int* columns = nullptr;
    const double* values = nullptr;

    void look();  ///< where the values lie at present
  };
  struct Row {
    const Source* source = nullptr;  ///< null where the unknown is missing
    int local = 0;
  };

  void find_followers(const Vector& hosts);
  void number_nodes();
  void number_ghosts();
  void fetch_ghosts(const std::vector<GlobalOrdinal>& numbers);
  void find_blocks();
  void count_unknowns();
  int place(GlobalOrdinal number);
  void add_columns_of(int node);
  void add_column(int node);
  bool is_plain(int node) const;

  const CrsMatrix* K_;
  int width_, n_own_nodes_;
  Nodes nodes_;  ///< by their numbers, while they are found
  std::unordered_map<GlobalOrdinal, std::vector<GlobalOrdinal>> followers_;  ///< of hosts, so long
  std::vector<int> group_;              ///< of each node: the first that stands where it does
  std::vector<GlobalOrdinal> numbers_;  ///< of the nodes
  std::vector<int> place_of_row_, ghost_places_;
  Teuchos::RCP<CrsMatrix> ghosts_;  ///< rows of other ranks; null where it is alone
  Teuchos::RCP<const Import> import_;
  Source own_, other_;
  std::vector<Row> rows_;  ///< by place
  std::vector<std::uint8_t> unknowns_;
  RowGraph graph_;
  std::vector<std::uint8_t> is_plain_;  ///< of each node: its blocks are read without a search
  std::vector<int> block_of_node_;      ///< scratch: by the columns' nodes; -1 between uses
};

}  // namespace tunica::smoothers
