#pragma once
#include <algorithm>
#include <cstdlib>
#include <map>
#include <vector>

#include "tunica/base/trilinos.hpp"
#include "tunica/base/types.hpp"

namespace tunica::test {

/// A box of nodes, numbered along x, then y, then z: the same on any number of ranks, each of
/// which owns one range of numbers.
struct Grid {
  int nx, ny, nz;
  bool has_corners;  ///< 26 neighbours, all of a cell; otherwise the 6 along the axes

  GlobalOrdinal n_nodes() const { return static_cast<GlobalOrdinal>(nx) * ny * nz; }
  int most_neighbours() const { return has_corners ? 26 : 6; }

  /// Ascending, without the node itself.
  std::vector<GlobalOrdinal> neighbours(GlobalOrdinal node) const {
    const int x = static_cast<int>(node % nx), y = static_cast<int>(node / nx % ny),
              z = static_cast<int>(node / nx / ny);
    std::vector<GlobalOrdinal> found;
    for (int k = z - 1; k <= z + 1; ++k)
      for (int j = y - 1; j <= y + 1; ++j)
        for (int i = x - 1; i <= x + 1; ++i) {
          const int steps = std::abs(i - x) + std::abs(j - y) + std::abs(k - z);
          const bool is_inside = i >= 0 && i < nx && j >= 0 && j < ny && k >= 0 && k < nz;
          if (is_inside && steps > 0 && (has_corners || steps == 1))
            found.push_back(i + static_cast<GlobalOrdinal>(nx) * (j + ny * k));
        }
    return found;
  }

  /// The Laplacian with zero values around the box, for each of `dofs` unknowns per node, which
  /// are numbered dofs*node + i.
  Teuchos::RCP<CrsMatrix> laplacian(const CommPtr& comm, int dofs = 1) const {
    const Map nodes(n_nodes(), 0, comm);
    const auto unknown = Teuchos::OrdinalTraits<Tpetra::global_size_t>::invalid();
    const Teuchos::RCP<const Map> map =
        Teuchos::rcp(new Map(unknown, dofs * n_local(nodes), 0, comm));
    const auto A = Teuchos::rcp(new CrsMatrix(map, 27));
    for (const GlobalOrdinal row : global_numbers(*map)) {
      std::vector<GlobalOrdinal> columns{row};
      for (const GlobalOrdinal node : neighbours(row / dofs))
        columns.push_back(dofs * node + row % dofs);
      std::vector<Scalar> values(columns.size(), -1.0);
      values[0] = most_neighbours();
      A->insertGlobalValues(row, Teuchos::arrayViewFromVector(columns),
                            Teuchos::arrayViewFromVector(values));
    }
    A->fillComplete();
    return A;
  }
  /// Of its nodes, each a neighbour of itself.
  Teuchos::RCP<const CrsGraph> graph(const CommPtr& comm) const {
    return laplacian(comm)->getCrsGraph();
  }
};

/// Nodes of n × n squares of two triangles each with quadratic functions.
inline Teuchos::RCP<const CrsGraph> quadratic_plane(const CommPtr& comm, int n) {
  const int m = 2 * n + 1;
  const auto nodes = Teuchos::rcp(new Map(m * m, 0, comm));
  const auto graph = Teuchos::rcp(new CrsGraph(nodes, 19));
  for (int corner = 0; corner < m * m; ++corner) {
    if (corner % m % 2 != 0 || corner / m % 2 != 0) continue;
    for (const int side : {1, m}) {  // two sides of the square and its diagonal
      if (corner % m == m - 1 || corner / m == m - 1) continue;
      const int far = corner + 2 * (m + 1), across = corner + m + 1;
      const std::vector<GlobalOrdinal> triangle{
          corner, corner + side, corner + 2 * side, far, across, corner + side + across - corner};
      for (const GlobalOrdinal node : triangle)
        if (nodes->isNodeGlobalElement(node))
          graph->insertGlobalIndices(node, Teuchos::arrayViewFromVector(triangle));
    }
  }
  graph->fillComplete();
  return graph;
}

/// The entries of an own row by their global columns.
inline std::map<GlobalOrdinal, Scalar> row_of(const CrsMatrix& A, GlobalOrdinal row) {
  const auto entries = A.getLocalMatrixHost().rowConst(A.getRowMap()->getLocalElement(row));
  std::map<GlobalOrdinal, Scalar> found;
  for (int k = 0; k < entries.length; ++k)
    found[A.getColMap()->getGlobalElement(entries.colidx(k))] = entries.value(k);
  return found;
}

/// The global columns of an own row, ascending.
inline std::vector<GlobalOrdinal> columns_of(const CrsGraph& G, GlobalOrdinal row) {
  const auto entries = G.getLocalGraphHost().rowConst(G.getRowMap()->getLocalElement(row));
  std::vector<GlobalOrdinal> found;
  for (int k = 0; k < entries.length; ++k)
    found.push_back(G.getColMap()->getGlobalElement(entries.colidx(k)));
  std::sort(found.begin(), found.end());
  return found;
}

}  // namespace tunica::test
