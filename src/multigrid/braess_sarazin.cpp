#include "multigrid/braess_sarazin.hpp"

#include <Amesos2.hpp>
#include <Ifpack2_Factory.hpp>
#include <cmath>
#include <stdexcept>

#include "base/agreement.hpp"
#include "multigrid/mixed_blocks.hpp"
#include "multigrid/schur_matrix.hpp"

namespace tunica::multigrid {

namespace {

using Relaxation = Ifpack2::Preconditioner<Scalar, LocalOrdinal, GlobalOrdinal, Node>;
using Direct = Amesos2::Solver<CrsMatrix, MultiVector>;

Teuchos::RCP<Relaxation> relaxation(const Teuchos::RCP<const CrsMatrix>& S,
                                    const BraessSarazinOptions& options) {
  const bool is_chebyshev = options.schur == "chebyshev";
  const Teuchos::RCP<const RowMatrix> rows = S;
  const auto inverse =
      Ifpack2::Factory::create<RowMatrix>(is_chebyshev ? "CHEBYSHEV" : "RELAXATION", rows);
  Teuchos::ParameterList list;
  if (is_chebyshev)
    list.set("chebyshev: degree", options.schur_sweeps);
  else
    list.set("relaxation: type", "Symmetric Gauss-Seidel")
        .set("relaxation: sweeps", options.schur_sweeps);
  inverse->setParameters(list);
  inverse->initialize();
  inverse->compute();
  return inverse;
}

}  // namespace

struct BraessSarazin::Parts {
  const CrsMatrix* K;
  BraessSarazinOptions options;
  MixedBlocks blocks;
  Teuchos::RCP<Vector> inverse_D;
  Teuchos::RCP<CrsMatrix> S;
  Teuchos::RCP<Relaxation> rough;
  Teuchos::RCP<Direct> exact;

  void solve_schur(const MultiVector& r, MultiVector& q) const {
    if (!rough.is_null()) return rough->apply(r, q);
    exact->setX(Teuchos::rcpFromRef(q));
    exact->setB(Teuchos::rcpFromRef(r));
    exact->solve();
  }
};

BraessSarazin::BraessSarazin(const CrsMatrix& K, const MixedNumbering& numbering,
                             const BraessSarazinOptions& options)
    : parts_(new Parts{&K, options, mixed_blocks(K, numbering), {}, {}, {}, {}}) {
  Parts& parts = *parts_;
  parts.inverse_D = Teuchos::rcp(new Vector(*parts.blocks.diagonal, Teuchos::Copy));
  parts.inverse_D->scale(options.scaling);
  std::string problem;
  {
    const auto d = parts.inverse_D->getLocalViewHost(read_only);
    for (std::size_t i = 0; i < d.extent(0); ++i)
      if (!(std::abs(d(i, 0)) > 0.0)) problem = "Braess-Sarazin: no pivot on the diagonal of A.";
  }
  problem = agreed_message(*K.getComm(), problem);
  if (!problem.empty()) throw std::runtime_error(problem);
  parts.inverse_D->reciprocal(*parts.inverse_D);
  parts.S = schur_matrix(*parts.blocks.B1T, *parts.blocks.B2, *parts.blocks.mC, *parts.inverse_D);
  if (options.schur != "direct") {
    parts.rough = relaxation(parts.S, options);
    return;
  }
  parts.exact = Amesos2::create<CrsMatrix, MultiVector>("KLU2", parts.S);
  parts.exact->symbolicFactorization().numericFactorization();
}

BraessSarazin::~BraessSarazin() = default;

void BraessSarazin::smooth(const MultiVector& b, MultiVector& x) const {
  const Parts& parts = *parts_;
  const auto u_map = parts.blocks.diagonal->getMap(), p_map = parts.blocks.mC->getRowMap();
  MultiVector r(b.getMap(), 1);
  Vector r_u(u_map), u(u_map), r_p(p_map), q(p_map);
  for (int sweep = 0; sweep < parts.options.sweeps; ++sweep) {
    parts.K->apply(x, r);
    r.update(1.0, b, -1.0);
    split(parts.blocks, r, r_u, r_p);
    u.elementWiseMultiply(1.0, *parts.inverse_D, r_u, 0.0);
    parts.blocks.B2->apply(u, r_p, Teuchos::NO_TRANS, 1.0, -1.0);  // B2 Ã⁻¹ r_u − r_p
    q.putScalar(0.0);
    parts.solve_schur(r_p, q);
    parts.blocks.B1T->apply(q, r_u, Teuchos::NO_TRANS, -1.0, 1.0);
    u.elementWiseMultiply(1.0, *parts.inverse_D, r_u, 0.0);
    add(parts.blocks, parts.options.damping, u, q, x);
  }
}

}  // namespace tunica::multigrid
