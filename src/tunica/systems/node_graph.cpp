#include "tunica/systems/node_graph.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace tunica::systems {

namespace {

constexpr double strong = 0.1;  ///< of the geometric mean of the diagonals

void sort_out(NodeGraph& graph) {
  for (auto& neighbours : graph) {
    std::sort(neighbours.begin(), neighbours.end());
    neighbours.erase(std::unique(neighbours.begin(), neighbours.end()), neighbours.end());
  }
}

std::vector<double> inverse_diagonal(const FileMatrix& A) {
  std::vector<double> inverse(A.n_rows, 0.0);
  for (long long i = 0; i < A.n_rows; ++i)
    for (std::size_t k = A.start[i]; k < A.start[i + 1]; ++k)
      if (A.columns[k] == i && A.values[k] != 0.0) inverse[i] = 1.0 / A.values[k];
  return inverse;
}

using SparseRows = std::vector<std::map<long long, double>>;

SparseRows schur_rows(const FileMatrix& A, const FileMatrix& B1T, const FileMatrix& B2,
                      const FileMatrix& mC) {
  const std::vector<double> inverse = inverse_diagonal(A);
  SparseRows S(B2.n_rows);
  for (long long i = 0; i < B2.n_rows; ++i) {
    for (std::size_t k = B2.start[i]; k < B2.start[i + 1]; ++k) {
      const long long u = B2.columns[k];
      const double factor = B2.values[k] * inverse[u];
      for (std::size_t m = B1T.start[u]; m < B1T.start[u + 1]; ++m)
        S[i][B1T.columns[m]] += factor * B1T.values[m];
    }
    for (std::size_t k = mC.start[i]; k < mC.start[i + 1]; ++k) S[i][mC.columns[k]] -= mC.values[k];
  }
  return S;
}

}  // namespace

NodeGraph vector_graph(const FileMatrix& A, const NodeTable& table) {
  NodeGraph graph(table.n_nodes);
  const auto couple = [&](long long a, long long b) {  // both ways: neighbours are mutual
    graph[a].push_back(b);
    graph[b].push_back(a);
  };
  for (long long i = 0; i < A.n_rows; ++i) {
    const long long node = table.vector_node[i];
    couple(node, node);
    for (std::size_t k = A.start[i]; k < A.start[i + 1]; ++k)
      if (table.vector_node[A.columns[k]] != node) couple(node, table.vector_node[A.columns[k]]);
  }
  sort_out(graph);
  return graph;
}

NodeGraph scalar_graph(const FileMatrix& A, const FileMatrix& B1T, const FileMatrix& B2,
                       const FileMatrix& mC, const NodeTable& table) {
  SparseRows S = schur_rows(A, B1T, B2, mC);
  NodeGraph graph(table.n_nodes);
  for (long long i = 0; i < B2.n_rows; ++i) {
    const long long node = table.scalar_node[i];
    graph[node].push_back(node);
    for (const auto& [j, value] : S[i]) {
      if (value * value < strong * strong * std::abs(S[i][i] * S[j][j])) continue;
      graph[node].push_back(table.scalar_node[j]);
      graph[table.scalar_node[j]].push_back(node);
    }
  }
  sort_out(graph);
  return graph;
}

}  // namespace tunica::systems
