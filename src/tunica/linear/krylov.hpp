#pragma once
#include <string>

#include "tunica/base/types.hpp"
#include "tunica/linear/gcr.hpp"

namespace tunica::linear {

struct KrylovOptions {
  std::string method;  ///< name of a Belos solver manager, or GCR
  int max_iterations;
  int restart;  ///< basis vectors kept, of methods that keep a basis; 0 for others
  /// Of GCR: directions from solves with the same matrix, which it begins with and adds to.
  Teuchos::RCP<Directions> recycled = Teuchos::null;
  int most_recycled = 0;
};

struct KrylovResult {
  int iterations;
  double recurrence_residual;  ///< relative
};

/// Solves A X = B from the X given by a Belos method with right preconditioning (null: none).
/// The residual is measured against |B|. Breakdown shows as a residual that is not small.
KrylovResult solve_krylov(const KrylovOptions& options, const Teuchos::RCP<const Operator>& A,
                          const Teuchos::RCP<const Operator>& preconditioner, const MultiVector& B,
                          MultiVector& X, double tolerance);

}  // namespace tunica::linear
