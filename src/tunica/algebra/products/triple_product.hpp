#pragma once
#include <Tpetra_Export.hpp>
#include <optional>
#include <vector>

#include "tunica/algebra/products/triple_kernel.hpp"

namespace tunica::algebra {

/// C = Pᵀ A P, and again for new values of A on the same graph, without the product of two between.
/// Each rank sums over its rows of A: what belongs to rows of C on other ranks is sent to them, and
/// the rows of P that columns of A need have been fetched from them. Entries of the graphs that are
/// zero count as any others.
class TripleProduct {
public:
  /// Rows and columns of A have the same numbers, among the columns of a rank are all its rows, and
  /// the rows of P are on the ranks of those of A. Collective.
  static bool serves(const CrsMatrix& A, const CrsMatrix& P);
  /// The graph alone: values come with refresh(). The matrices must outlive the object. Throws
  /// std::invalid_argument where they are not served. Collective.
  TripleProduct(const CrsMatrix& A, const CrsMatrix& P);

  const Teuchos::RCP<CrsMatrix>& matrix() const { return product_; }
  /// Numeric work only. Collective.
  void refresh();

private:
  void fetch_rows();
  void join_ranks();

  const CrsMatrix *A_, *P_;  ///< P: with a row for each column of A
  Teuchos::RCP<CrsMatrix> fetched_;
  std::optional<TripleKernel> kernel_;
  Teuchos::RCP<CrsMatrix> product_;
  // Where ranks have to exchange rows: the sums of this rank, for its own rows and those of others
  Teuchos::RCP<CrsMatrix> own_, others_;
  std::vector<int> own_offsets_;  ///< of the values of own_ in the product
  Teuchos::RCP<const Tpetra::Export<LocalOrdinal, GlobalOrdinal, Node>> to_owners_;
  std::vector<int> own_rows_, other_rows_;  ///< of the kernel
};

}  // namespace tunica::algebra
