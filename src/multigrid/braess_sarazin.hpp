#pragma once
#include <memory>
#include <string>

#include "multigrid/mixed_numbering.hpp"

namespace tunica::multigrid {

struct BraessSarazinOptions {
  int sweeps = 1;
  double scaling = 2.0;                ///< Ã = scaling diag(A)
  double damping = 1.0;                ///< of the whole correction
  std::string schur = "gauss-seidel";  ///< inverse of S: "gauss-seidel", "chebyshev",
                                       ///< "multigrid" (one cycle), "direct"
  int schur_sweeps = 2;  ///< of Gauss-Seidel, also in the cycle, or the degree of Chebyshev
};

/// The smoother of Braess and Sarazin [BS97] for K = [A B1ᵀ; B2 −C]: x += ω K̃⁻¹ (b − K x) where K̃
/// has Ã = s diag(A) in the place of A (s = 1 in rows with nothing else), and
/// S = C + B2 Ã⁻¹ B1ᵀ is inverted roughly or exactly.
class BraessSarazin {
public:
  /// K must outlive the smoother. Throws std::runtime_error for a zero on the diagonal of A.
  /// Collective.
  BraessSarazin(const CrsMatrix& K, const MixedNumbering& numbering,
                const BraessSarazinOptions& options);
  ~BraessSarazin();

  /// Takes new values of K over; its graph must be the same. Throws as the constructor. Collective.
  void refresh();

  /// x ← x after the sweeps. Collective.
  void smooth(const MultiVector& b, MultiVector& x) const;

private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace tunica::multigrid
