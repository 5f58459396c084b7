#pragma once
#include <vector>

#include "tunica/algebra/dof_layout.hpp"

namespace tunica::smoothers {

/// The blocks off the velocity's diagonal of a mixed matrix, and that diagonal: copies, in the
/// numbers of the blocks.
class MixedBlocks {
public:
  /// K must outlive the object. Collective.
  MixedBlocks(const CrsMatrix& K, const algebra::DofLayout& layout);

  /// Takes new values of K over. Collective.
  void refresh();

  Teuchos::RCP<CrsMatrix> B1T, B2, mC;  ///< mC holds −C
  Teuchos::RCP<Vector> diagonal;        ///< of A
  std::vector<char> is_uncovered;       ///< rows of A with nothing but the diagonal

  /// Takes the two parts out of a vector of all unknowns.
  void split(const MultiVector& all, Vector& u, Vector& p) const;
  /// all += factor (u, p).
  void add(Scalar factor, const Vector& u, const Vector& p, MultiVector& all) const;

private:
  const CrsMatrix* K_;
  std::vector<int> vector_rows_, scalar_rows_;  ///< local row of K of each row of the blocks
  std::vector<int> offsets_of_B1T_, offsets_of_B2_, offsets_of_mC_;  ///< in the values of K
};

}  // namespace tunica::smoothers
