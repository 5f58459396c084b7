#pragma once
#include <functional>
#include <memory>
#include <string>

#include "tunica/algebra/dof_layout.hpp"
#include "tunica/algebra/refreshable.hpp"

namespace tunica::smoothers {

struct BraessSarazinOptions {
  int sweeps = 1;
  double scaling = 0.0;  ///< s in Ã = s diag(A); 0: by the spectrum of diag(A)⁻¹ A
  double damping = 1.0;  ///< of the whole correction
  std::string schur = "gauss-seidel";  ///< inverse of S: "gauss-seidel", "chebyshev", "direct"
  int schur_sweeps = 2;                ///< of Gauss-Seidel, or the degree of Chebyshev
};

/// Inverts the Schur complement S, roughly or exactly.
class SchurSolver : public algebra::Refreshable {
public:
  /// q ≈ S⁻¹ r; q is zero on entry. Collective.
  virtual void solve(const MultiVector& r, MultiVector& q) const = 0;
};

/// Makes a solver for S; nodes: the graph of C, which is that of the mesh. S couples wider.
using MakeSchurSolver = std::function<std::unique_ptr<SchurSolver>(
    const Teuchos::RCP<CrsMatrix>& S, const Teuchos::RCP<const CrsMatrix>& nodes)>;

/// The smoother of Braess and Sarazin [BS97] for K = [A B1ᵀ; B2 −C]: x += ω K̃⁻¹ (b − K x) where K̃
/// has Ã = s diag(A) in the place of A (s = 1 in rows with nothing else), and
/// S = C + B2 Ã⁻¹ B1ᵀ is inverted roughly or exactly. Sweeps converge for s > λ/2 only, λ the
/// largest eigenvalue of diag(A)⁻¹ A: 2.0 to 2.2 of velocities, 3.4 of plane elasticity.
class BraessSarazin {
public:
  /// K must outlive the smoother. make_schur, where given, takes the place of options.schur. Throws
  /// std::runtime_error for a zero on the diagonal of A. Collective.
  BraessSarazin(const CrsMatrix& K, const algebra::DofLayout& numbering,
                const BraessSarazinOptions& options, const MakeSchurSolver& make_schur = {});
  ~BraessSarazin();

  /// Takes new values of K over; its graph must be the same. Throws as the constructor. Collective.
  void refresh();

  /// x ← x after the sweeps, column by column. Throws std::invalid_argument for unlike numbers of
  /// columns. Collective.
  void smooth(const MultiVector& b, MultiVector& x) const;

private:
  void smooth_column(const MultiVector& b, MultiVector& x) const;

  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace tunica::smoothers
