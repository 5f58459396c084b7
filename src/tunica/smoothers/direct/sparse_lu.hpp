#pragma once
#include <functional>
#include <memory>

#include "tunica/base/types.hpp"

namespace tunica::smoothers {

/// Factors of a matrix all of whose rows are on one rank; not collective.
class Factors {
public:
  virtual ~Factors() = default;

  /// Factors the present values. Throws std::bad_alloc, or std::runtime_error where the matrix is
  /// singular.
  virtual void refactor() = 0;
  /// X = A⁻¹ B, with any number of columns.
  virtual void solve(const MultiVector& B, MultiVector& X) const = 0;
};

/// Makes the factors of a matrix that is still without values.
using MakeFactors =
    std::function<std::unique_ptr<Factors>(const Teuchos::RCP<const CrsMatrix>& alone)>;

/// Sparse LU factors on rank 0. The rows are ordered once, new values of the same matrix are
/// factored again. A solve is two collective calls: Amesos2 by itself finds its maps and plans of
/// communication anew in each, some 40 calls.
class SparseLu {
public:
  /// By KLU2, for small matrices. The numbers of the rows may have gaps; the graph must not change.
  /// Collective.
  explicit SparseLu(const Teuchos::RCP<const CrsMatrix>& A);
  /// By others.
  SparseLu(const Teuchos::RCP<const CrsMatrix>& A, const MakeFactors& make);
  ~SparseLu();
  SparseLu(const SparseLu&) = delete;
  SparseLu& operator=(const SparseLu&) = delete;

  /// Factors the present values. Throws on all ranks std::bad_alloc, or std::runtime_error where
  /// the matrix is singular. Collective.
  void refactor();

  /// What rank 0 answers about its factors. Collective.
  double told(const std::function<double(Factors&)>& question) const;

  /// X = A⁻¹ B, with any number of columns. Collective.
  void solve(const MultiVector& B, MultiVector& X) const;

private:
  class Gathered;

  Teuchos::RCP<const CrsMatrix> A_;
  std::unique_ptr<Gathered> gathered_;  ///< null on one rank
  std::unique_ptr<Factors> factors_;    ///< of all on one rank, of the gathered on rank 0, or null
};

}  // namespace tunica::smoothers
