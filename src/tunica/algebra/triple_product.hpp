#pragma once
#include <vector>

#include "tunica/base/types.hpp"

namespace tunica::algebra {

/// Neighbouring rows that are worked on together, those of a node.
struct Groups {
  static constexpr int most = 4;  ///< rows of a group
  std::vector<int> start;         ///< the first row of each, and the number of rows
  std::vector<int> of;            ///< by row
  int size() const { return static_cast<int>(start.size()) - 1; }
};

/// C = Pᵀ A P, and again for new values of A and P on the same graphs, without the product of two
/// between: for matrices that lie on one rank. Rows that stand side by side with the same columns,
/// those of a node, are worked on together. Entries of the graphs that are zero count as any
/// others.
class TripleProduct {
public:
  /// The matrices lie on one rank and number rows and columns alike.
  static bool serves(const CrsMatrix& A, const CrsMatrix& P);
  /// The graph alone: values come with refresh(). The matrices must outlive the object. Throws
  /// std::invalid_argument where they are not served.
  TripleProduct(const CrsMatrix& A, const CrsMatrix& P);

  const Teuchos::RCP<CrsMatrix>& matrix() const { return product_; }
  /// Numeric work only.
  void refresh();

private:
  class Chunk;

  const CrsMatrix *A_, *P_;
  Teuchos::RCP<CrsMatrix> product_;
  Groups fine_, coarse_;
  std::vector<std::size_t> parent_start_{0};  ///< by group of rows of A
  std::vector<int> parents_;                  ///< groups of columns in which P has these rows
};

}  // namespace tunica::algebra
