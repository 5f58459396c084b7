#pragma once
#include "tunica/linear/action_sum.hpp"
#include "tunica/linear/low_rank.hpp"

namespace tunica::linear {

/// A block matrix on the vectors that a solver works on: the matrix A of its blocks, its part of
/// low rank and its part without entries; and inverses or preconditioners of A made those of all
/// but the last.
class AugmentedSystem {
public:
  /// A: of the blocks of K, which must outlive the object.
  AugmentedSystem(const algebra::BlockMatrix& K, const Teuchos::RCP<const Operator>& A,
                  const ActionSum::Gather& gather, const ActionSum::Scatter& scatter);

  bool has_low_rank() const { return !sum_.is_null(); }
  bool has_action() const { return !whole_.is_null(); }

  /// A with all that K has beside its blocks.
  Teuchos::RCP<const Operator> matrix() const;
  /// A with the part of low rank alone.
  Teuchos::RCP<const Operator> matrix_with_low_rank() const;
  /// Takes over the present values of the part of low rank.
  void refresh_matrix();

  /// Makes P_inverse, of A, one for the part of low rank, too. False where the sum is singular.
  /// Collective.
  bool refresh_inverse(const Teuchos::RCP<const Operator>& P_inverse,
                       const LowRankInverse::Solve& solve);
  /// What its set-up keeps for the next, see LowRankInverse; none without a part of low rank.
  std::vector<Vector> solutions() const;
  void set_solutions(std::vector<Vector> Z);
  /// P_inverse as extended by refresh_inverse(); P_inverse itself if there is no low-rank part.
  Teuchos::RCP<const Operator> inverse(const Teuchos::RCP<const Operator>& P_inverse) const;

private:
  Teuchos::RCP<const Operator> A_;
  Teuchos::RCP<LowRankSum> sum_;  ///< both null where K has no part of low rank
  Teuchos::RCP<LowRankInverse> sum_inverse_;
  Teuchos::RCP<ActionSum> whole_;  ///< null where K has no part without entries
};

}  // namespace tunica::linear
