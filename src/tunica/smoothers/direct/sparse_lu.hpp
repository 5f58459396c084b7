#pragma once
#include <memory>

#include "tunica/base/types.hpp"

namespace tunica::smoothers {

/// Sparse LU factors by KLU2, on rank 0; for small matrices. The rows are ordered once, new values
/// of the same matrix are factored again. A solve is two collective calls: Amesos2 by
/// itself finds its maps and plans of communication anew in each, some 40 calls.
class SparseLu {
public:
  /// The numbers of the rows may have gaps; the graph must not change. Collective.
  explicit SparseLu(const Teuchos::RCP<const CrsMatrix>& A);
  ~SparseLu();
  SparseLu(const SparseLu&) = delete;
  SparseLu& operator=(const SparseLu&) = delete;

  /// Factors the present values. Throws on all ranks std::bad_alloc, or std::runtime_error where
  /// the matrix is singular. Collective.
  void refactor();

  /// Estimated bytes of the factors, from an elimination order like that of KLU2, before they are
  /// made; valid as long as no pivot is off the diagonal. Collective.
  double expected_bytes() const;

  /// X = A⁻¹ B, with any number of columns. Collective.
  void solve(const MultiVector& B, MultiVector& X) const;

private:
  class Gathered;
  class Factors;

  Teuchos::RCP<const CrsMatrix> A_;
  std::unique_ptr<Gathered> gathered_;  ///< null on one rank
  std::unique_ptr<Factors> factors_;    ///< of all on one rank, of the gathered on rank 0, or null
};

}  // namespace tunica::smoothers
