#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

#include "tunica/algebra/products/groups.hpp"

namespace tunica::algebra {

/// The sum of Pᵀ A P over the rows of this rank, C = Σ_i P_iᵀ A_i· P, in groups of rows and of
/// columns with all places found beforehand. P has a row for each local column of A, and its
/// columns number rows and columns of C. Entries of the graphs that are zero count as any others.
class TripleKernel {
public:
  using Graph = LocalGraph;
  using Matrix = CrsMatrix::local_matrix_host_type;

  /// diagonal: the column of A that each of its rows has the number of.
  TripleKernel(const Graph& A, const Graph& P, std::vector<int> diagonal, int n_coarse);

  /// The graph of C: columns ascend in each row.
  const std::vector<std::size_t>& row_start() const { return row_start_; }
  const std::vector<int>& columns() const { return columns_; }
  /// Once the graph is of no more use. An empty list in braces would leave the storage.
  void forget_columns() { columns_ = std::vector<int>(); }

  /// Adds to C, each of whose rows has its values at the given place.
  void add(const Matrix& A, const Matrix& P, const std::vector<double*>& rows_of_C) const;

private:
  struct Scratch;

  void find_graph(const Graph& A, const Graph& P, int n_coarse);
  void find_groups(const Graph& A, const Graph& P);
  void find_places();
  void multiply(int g, const Matrix& A, const Matrix& P, Scratch& s) const;
  void gather_weights(int g, const Matrix& P, Scratch& s) const;

  std::vector<int> diagonal_;
  std::vector<std::size_t> row_start_;
  std::vector<int> columns_;
  Groups rows_;                          ///< of A
  Groups coarse_rows_, coarse_columns_;  ///< of C
  // By group of rows of A: groups of columns of A P, and of rows of C to which it adds
  std::vector<std::size_t> product_start_{0}, parent_start_{0};
  std::vector<int> products_, parents_;
  /// Where each such group of columns begins in each such row of C, parent by parent.
  std::vector<std::uint16_t> places_;
};

}  // namespace tunica::algebra
