#pragma once
#include "tunica/linear/direct/nested_dissection.hpp"
#include "tunica/smoothers/direct/sparse_lu.hpp"

namespace tunica::linear {

/// Sparse LU factors by MUMPS [ADKL], of a matrix all of whose rows are on one rank. An entry is a
/// pivot where it is at least 1 % of the largest of its column: diagonals may be zero.
class MultifrontalLu final : public smoothers::Factors {
public:
  /// Orders the unknowns so that fill is small, step by step. Not where factors take more
  /// operations than most in any order (0: any number), for which that would take longer than a
  /// solution by other means: then only expected_operations() may be asked for.
  explicit MultifrontalLu(const Teuchos::RCP<const CrsMatrix>& A, double most_operations = 0.0);
  ~MultifrontalLu() override;

  /// What the factors will take, valid as long as few pivots are off the diagonal: floating-point
  /// operations, and bytes.
  double expected_operations() const;
  bool is_ordered() const { return least_operations_ == 0.0; }
  double expected_bytes() const;

  /// Tries nested dissection for an order too, and keeps the better one of both.
  void dissect();

  void refactor() override;
  void solve(const MultiVector& B, MultiVector& X) const override;

private:
  class Instance;

  Teuchos::RCP<const CrsMatrix> A_;
  Entries entries_;  ///< from 1, as MUMPS counts
  std::unique_ptr<Instance> mumps_;
  double least_operations_ = 0.0;  ///< in any order, where they are too many
};

}  // namespace tunica::linear
