#include "tunica/smoothers/braess_sarazin/braess_sarazin.hpp"

#include <Ifpack2_Factory.hpp>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "tunica/algebra/columns.hpp"
#include "tunica/base/agreement.hpp"
#include "tunica/smoothers/braess_sarazin/mixed_blocks.hpp"
#include "tunica/smoothers/braess_sarazin/ritz_values.hpp"
#include "tunica/smoothers/braess_sarazin/schur_matrix.hpp"
#include "tunica/smoothers/direct/sparse_lu.hpp"

namespace tunica::smoothers {

namespace {

using Relaxation = Ifpack2::Preconditioner<Scalar, LocalOrdinal, GlobalOrdinal, Node>;

/// Sweeps of symmetric Gauss-Seidel, or a Chebyshev polynomial, of S (Ifpack2).
class RelaxedSchur final : public SchurSolver {
public:
  RelaxedSchur(const Teuchos::RCP<const RowMatrix>& S, const BraessSarazinOptions& options)
      : inverse_(Ifpack2::Factory::create<RowMatrix>(
            options.schur == "chebyshev" ? "CHEBYSHEV" : "RELAXATION", S)) {
    Teuchos::ParameterList list;
    if (options.schur == "chebyshev")
      list.set("chebyshev: degree", options.schur_sweeps);
    else
      list.set("relaxation: type", "Symmetric Gauss-Seidel")
          .set("relaxation: sweeps", options.schur_sweeps);
    inverse_->setParameters(list);
    inverse_->initialize();
    inverse_->compute();
  }

  void refresh() override { inverse_->compute(); }
  void solve(const MultiVector& r, MultiVector& q) const override { inverse_->apply(r, q); }

private:
  Teuchos::RCP<Relaxation> inverse_;
};

// s = max(1, share |μ|²/Re μ) over the eigenvalues μ of diag(A)⁻¹ A. Sweeps converge for s above
// half of that. Errors that coarse levels do not see have eigenvalues from a quarter of the largest
// on; a share between 0.6 and 0.75 takes the fewest cycles. The mean of all eigenvalues is 1: where
// none is much larger, A is close to its diagonal.
constexpr double share = 0.7;
constexpr double most_turned = 1.5;  ///< |μ|/Re μ; of convection it may be anything
constexpr int arnoldi_steps = 10;
constexpr double usual = 2.0;  ///< s where eigenvalues are not to be had

/// Sparse LU factors of S.
class FactoredSchur final : public SchurSolver {
public:
  explicit FactoredSchur(const Teuchos::RCP<const CrsMatrix>& S) : lu_(S) { lu_.refactor(); }

  void refresh() override { lu_.refactor(); }
  void solve(const MultiVector& r, MultiVector& q) const override { lu_.solve(r, q); }

private:
  SparseLu lu_;
};

}  // namespace

struct BraessSarazin::Parts {
  Parts(const CrsMatrix& matrix, const algebra::DofLayout& numbering, const BraessSarazinOptions& o)
      : K(&matrix), options(o), blocks(matrix, numbering), inverse_D(blocks.diagonal->getMap()) {}

  const CrsMatrix* K;
  BraessSarazinOptions options;
  MixedBlocks blocks;
  Vector inverse_D;
  std::unique_ptr<SchurMatrix> S;
  std::unique_ptr<SchurSolver> schur;

  /// Ã⁻¹. Rows with nothing but the diagonal are solved, not smoothed: s = 1.
  void invert_diagonal() {
    invert_entries();
    const double s = options.scaling > 0.0 ? options.scaling : scaling_by_spectrum();
    const auto inverse = inverse_D.getLocalViewHost(read_write);
    for (std::size_t i = 0; i < inverse.extent(0); ++i)
      if (!blocks.is_uncovered[i]) inverse(i, 0) /= s;
  }

private:
  void invert_entries() {
    std::string problem;
    {
      const auto d = blocks.diagonal->getLocalViewHost(read_only);
      const auto inverse = inverse_D.getLocalViewHost(overwrite_all);
      for (std::size_t i = 0; i < d.extent(0); ++i) {
        if (!(std::abs(d(i, 0)) > 0.0)) problem = "Braess-Sarazin: no pivot on the diagonal of A.";
        inverse(i, 0) = 1.0 / d(i, 0);
      }
    }
    throw_if_any<std::runtime_error>(*K->getComm(), problem);
  }

  /// Wants diag(A)⁻¹ in inverse_D.
  double scaling_by_spectrum() const {
    Vector scalars(blocks.mC->getRowMap());
    MultiVector all(K->getRowMap(), 1), K_all(K->getRowMap(), 1);
    const auto values = ritz_values(
        inverse_D.getMap(),
        [&](const Vector& x, Vector& y) {
          all.putScalar(0.0);
          scalars.putScalar(0.0);
          blocks.add(1.0, x, scalars, all);
          K->apply(all, K_all);  // (A x, B2 x)
          blocks.split(K_all, y, scalars);
          y.elementWiseMultiply(1.0, inverse_D, y, 0.0);
        },
        arnoldi_steps);
    double largest = 0.0;
    for (const std::complex<double>& mu : values)
      largest = std::max(largest, std::abs(mu) * std::min(std::abs(mu) / mu.real(), most_turned));
    return largest > 0.0 ? std::max(1.0, share * largest) : usual;
  }
};

BraessSarazin::BraessSarazin(const CrsMatrix& K, const algebra::DofLayout& numbering,
                             const BraessSarazinOptions& options, const MakeSchurSolver& make_schur)
    : parts_(new Parts(K, numbering, options)) {
  Parts& parts = *parts_;
  parts.invert_diagonal();
  const MixedBlocks& blocks = parts.blocks;
  parts.S = std::make_unique<SchurMatrix>(*blocks.B1T, *blocks.B2, *blocks.mC, parts.inverse_D);
  const Teuchos::RCP<CrsMatrix> S = parts.S->matrix();
  if (make_schur)
    parts.schur = make_schur(S, blocks.mC);
  else if (options.schur == "direct")
    parts.schur = std::make_unique<FactoredSchur>(S);
  else
    parts.schur = std::make_unique<RelaxedSchur>(S, options);
}

BraessSarazin::~BraessSarazin() = default;

// Ã and S follow the values of K, on the graphs of the first set-up.
void BraessSarazin::refresh() {
  Parts& parts = *parts_;
  parts.blocks.refresh();
  parts.invert_diagonal();
  parts.S->refresh(parts.inverse_D);
  parts.schur->refresh();
}

void BraessSarazin::smooth(const MultiVector& b, MultiVector& x) const {
  algebra::for_each_column("BraessSarazin", b, x,
                           [&](const auto& b_c, auto& x_c) { smooth_column(b_c, x_c); });
}

// K̃ (u, q) = r by its factors, K̃ = [Ã B1ᵀ; B2 −C]:
//
//   S q = B2 Ã⁻¹ r_u − r_p,   Ã u = r_u − B1ᵀ q,   S = C + B2 Ã⁻¹ B1ᵀ
//
// S is all that is inverted inexactly.
void BraessSarazin::smooth_column(const MultiVector& b, MultiVector& x) const {
  const Parts& parts = *parts_;
  const MixedBlocks& blocks = parts.blocks;
  MultiVector r(b.getMap(), 1);
  Vector r_u(parts.inverse_D.getMap()), u(r_u.getMap());
  Vector r_p(blocks.mC->getRowMap()), q(r_p.getMap());
  for (int sweep = 0; sweep < parts.options.sweeps; ++sweep) {
    parts.K->apply(x, r);
    r.update(1.0, b, -1.0);  // r = b − K x
    blocks.split(r, r_u, r_p);
    u.elementWiseMultiply(1.0, parts.inverse_D, r_u, 0.0);
    blocks.B2->apply(u, r_p, Teuchos::NO_TRANS, 1.0, -1.0);
    q.putScalar(0.0);
    parts.schur->solve(r_p, q);  // q = S̃⁻¹ (B2 Ã⁻¹ r_u − r_p)
    blocks.B1T->apply(q, r_u, Teuchos::NO_TRANS, -1.0, 1.0);
    u.elementWiseMultiply(1.0, parts.inverse_D, r_u, 0.0);  // u = Ã⁻¹ (r_u − B1ᵀ q)
    blocks.add(parts.options.damping, u, q, x);             // x += ω (u, q)
  }
}

}  // namespace tunica::smoothers
