#include "tunica/systems/node_graph.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "tunica/base/agreement.hpp"
#include "tunica/base/exchange.hpp"
#include "tunica/base/sort_once.hpp"

namespace tunica::systems {

namespace {

constexpr double strong = 0.1;  ///< of the geometric mean of the diagonals

/// Part of the neighbours that a vector and the scalar of its node have in common at least. On a
/// grid of cubes of six tetrahedra each, where C has only the neighbours along its lines, 0.4.
constexpr double least_common = 0.3;

/// Takes pairs of nodes, found on any rank again and again, to the ranks that have the first.
class EdgeCollector {
public:
  EdgeCollector(long long n_nodes, const CommPtr& comm) : comm_(comm), n_nodes_(n_nodes) {}

  /// Both ways: neighbours are mutual.
  void couple(long long a, long long b) {
    found_.add({a, b});
    if (a != b) found_.add({b, a});
  }
  /// Sends what was found since the last time. Collective.
  void deliver() {
    const std::vector<Edge> edges = found_.take();
    std::vector<int> ranks;
    ranks.reserve(edges.size());
    for (const Edge& edge : edges) ranks.push_back(rank_of_row(edge[0], n_nodes_, *comm_));
    for (const Edge& edge : exchange_to(*comm_, edges, ranks).items) delivered_.add(edge);
  }
  /// Leaves none.
  NodeGraph take() {
    NodeGraph graph = empty_matrix(n_nodes_, n_nodes_, comm_);
    const long long first = graph.first_row();
    for (const auto& [node, neighbour] : delivered_.take()) {
      ++graph.start[node - first + 1];
      graph.columns.push_back(neighbour);
    }
    for (std::size_t i = 0; i < graph.n_local_rows(); ++i) graph.start[i + 1] += graph.start[i];
    return graph;
  }

private:
  using Edge = std::array<long long, 2>;

  CommPtr comm_;
  long long n_nodes_;
  Once<Edge> found_, delivered_;
};

std::vector<double> inverse_diagonal(const MatrixRows& A) {
  std::vector<double> inverse = diagonal(A);
  for (double& value : inverse) value = value != 0.0 ? 1.0 / value : 0.0;
  return inverse;
}

/// Rows of C + B2 diag(A)⁻¹ B1ᵀ. Terms are added in the order of B2's row, whatever the ranks.
MatrixRows schur_rows(const MatrixRows& A, const MatrixRows& B1T, const MatrixRows& B2,
                      const MatrixRows& mC) {
  const Fetched<double> inverse(*A.comm, columns_of(B2), inverse_diagonal(A), A.n_rows);
  MatrixRows S = empty_matrix(B2.n_rows, B2.n_rows, B2.comm);
  in_batches(B2, [&](std::size_t first, std::size_t last) {
    const std::vector<Entry> right = fetch_rows(B1T, columns_of(B2, first, last));
    for (std::size_t i = first; i < last; ++i) {
      std::map<long long, double> row;
      for (std::size_t k = B2.start[i]; k < B2.start[i + 1]; ++k) {
        const long long u = B2.columns[k];
        const double factor = B2.values[k] * inverse(u);
        auto entry = std::partition_point(right.begin(), right.end(),
                                          [u](const Entry& e) { return e.row < u; });
        for (; entry != right.end() && entry->row == u; ++entry)
          row[entry->column] += factor * entry->value;
      }
      for (std::size_t k = mC.start[i]; k < mC.start[i + 1]; ++k)
        row[mC.columns[k]] -= mC.values[k];
      for (const auto& [column, value] : row) {
        S.columns.push_back(column);
        S.values.push_back(value);
      }
      S.start[i + 1] = S.columns.size();
    }
  });
  return S;
}

/// Nodes of the rows with those of the columns that an entry couples. Collective.
void couple_all(const MatrixRows& A, const std::vector<long long>& node_of_row,
                const std::vector<long long>& node_of_column, EdgeCollector& edges) {
  const Fetched<long long> node_of(*A.comm, columns_of(A), node_of_column, A.n_columns);
  in_batches(A, [&](std::size_t first, std::size_t last) {
    // Rows of a node often follow each other, and reach the same nodes.
    long long own = -1;
    std::vector<long long> reached;
    const auto couple = [&] {
      sort_once(reached);
      for (const long long node : reached) edges.couple(own, node);
      reached.clear();
    };
    for (std::size_t i = first; i < last; ++i) {
      if (node_of_row[i] != own) couple();
      own = node_of_row[i];
      for (std::size_t k = A.start[i]; k < A.start[i + 1]; ++k)
        reached.push_back(node_of(A.columns[k]));
    }
    couple();
    edges.deliver();
  });
}

/// Scalars that the vectors of each node reach in B1T. Collective.
MatrixRows reach_of_nodes(const MatrixRows& B1T, int components, bool is_by_node) {
  const long long n = B1T.n_rows / components;
  RowCollector collector(n, B1T.n_columns, B1T.comm);
  in_batches(B1T, [&](std::size_t first, std::size_t last) {
    std::vector<Entry> entries;
    for (std::size_t i = first; i < last; ++i) {
      const long long row = B1T.first_row() + static_cast<long long>(i);
      for (std::size_t k = B1T.start[i]; k < B1T.start[i + 1]; ++k)
        entries.push_back({is_by_node ? row / components : row % n, B1T.columns[k], 1.0});
    }
    collector.add(entries);
  });
  return collector.take();
}

/// The scalar with most common neighbours; -1 where none has enough.
class LikeliestScalar {
public:
  /// neighbours: entries of C in the rows of all that may be reached. Collective.
  LikeliestScalar(const MatrixRows& C, std::vector<Entry> neighbours,
                  const std::vector<std::size_t>& lengths)
      : neighbours_(std::move(neighbours)),
        length_(*C.comm, columns_of(neighbours_), lengths, C.n_rows) {}

  // s with the largest |R ∩ N_s| / |R ∪ N_s|: R are those reached, N_s the columns of C in row s
  long long operator()(const long long* reached, std::size_t n_reached) const {
    std::map<long long, std::size_t> common;
    for (std::size_t k = 0; k < n_reached; ++k) {
      auto entry = std::partition_point(neighbours_.begin(), neighbours_.end(),
                                        [&](const Entry& e) { return e.row < reached[k]; });
      for (; entry != neighbours_.end() && entry->row == reached[k]; ++entry)
        ++common[entry->column];
    }
    long long likeliest = -1;
    double most = least_common;
    for (const auto& [scalar, n] : common) {
      const auto all = static_cast<double>(n_reached + length_(scalar) - n);
      if (const double part = static_cast<double>(n) / all; part > most) {
        most = part;
        likeliest = scalar;
      }
    }
    return likeliest;
  }

private:
  static std::vector<long long> columns_of(const std::vector<Entry>& entries) {
    std::vector<long long> columns;
    for (const Entry& entry : entries) columns.push_back(entry.column);
    sort_once(columns);
    return columns;
  }

  std::vector<Entry> neighbours_;
  Fetched<std::size_t> length_;
};

/// No number is -1 or there twice. Collective.
bool are_claimed_once(const std::vector<long long>& scalars, long long n_scalars,
                      const Comm& comm) {
  if (!all_agree(comm, std::count(scalars.begin(), scalars.end(), -1) == 0)) return false;
  std::vector<int> ranks;
  for (const long long scalar : scalars) ranks.push_back(rank_of_row(scalar, n_scalars, comm));
  std::vector<long long> claims = exchange_to(comm, scalars, ranks).items;
  const std::size_t n = claims.size();
  sort_once(claims);
  return all_agree(comm, claims.size() == n);
}

}  // namespace

ScalarsBeside scalars_beside(const Blocks& blocks, int components, bool is_by_node) {
  const long long n_scalars = blocks.n_rows(1), n = blocks.n_rows(0) / components;
  const bool are_alike =
      components > 1 && blocks.n_rows(0) % components == 0 && n < n_scalars && n_scalars <= 2 * n;
  if (!are_alike) return {};
  const MatrixRows& C = blocks.mC;
  std::vector<std::size_t> lengths;
  for (std::size_t i = 0; i < C.n_local_rows(); ++i) lengths.push_back(C.start[i + 1] - C.start[i]);
  const MatrixRows reach = reach_of_nodes(blocks.B1T, components, is_by_node);
  ScalarsBeside beside;
  in_batches(reach, [&](std::size_t first, std::size_t last) {
    const LikeliestScalar likeliest(C, fetch_rows(C, columns_of(reach, first, last)), lengths);
    for (std::size_t i = first; i < last; ++i)
      beside.of_node.push_back(
          likeliest(reach.columns.data() + reach.start[i], reach.start[i + 1] - reach.start[i]));
  });
  beside.are_known = are_claimed_once(beside.of_node, n_scalars, *C.comm);
  return beside;
}

NodeGraph vector_graph(const Blocks& blocks, const NodeTable& table) {
  EdgeCollector edges(table.n_nodes, blocks.A.comm);
  couple_all(blocks.A, table.vector_node, table.vector_node, edges);
  if (table.is_shared) {
    couple_all(blocks.B1T, table.vector_node, table.scalar_node, edges);
    couple_all(blocks.B2, table.scalar_node, table.vector_node, edges);
    couple_all(blocks.mC, table.scalar_node, table.scalar_node, edges);
  }
  return edges.take();
}

NodeGraph scalar_graph(const Blocks& blocks, const NodeTable& table) {
  struct OfScalar {
    long long node;
    double diagonal;
  };
  const MatrixRows S = schur_rows(blocks.A, blocks.B1T, blocks.B2, blocks.mC);
  std::vector<OfScalar> mine;
  for (const double value : diagonal(S)) mine.push_back({table.scalar_node[mine.size()], value});
  const Fetched<OfScalar> scalar(*S.comm, columns_of(S), mine, S.n_rows);
  EdgeCollector edges(table.n_nodes, S.comm);
  in_batches(S, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i)
      for (std::size_t k = S.start[i]; k < S.start[i + 1]; ++k) {
        const auto& [node, other_diagonal] = scalar(S.columns[k]);
        const double value = S.values[k];
        if (value * value < strong * strong * std::abs(mine[i].diagonal * other_diagonal)) continue;
        edges.couple(mine[i].node, node);
      }
    edges.deliver();
  });
  return edges.take();
}

}  // namespace tunica::systems
