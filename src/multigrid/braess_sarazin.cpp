#include "multigrid/braess_sarazin.hpp"

#include <Ifpack2_Factory.hpp>
#include <cmath>
#include <stdexcept>

#include "base/agreement.hpp"
#include "multigrid/cycle.hpp"
#include "multigrid/mixed_blocks.hpp"
#include "multigrid/schur_matrix.hpp"
#include "multigrid/sparse_lu.hpp"

namespace tunica::multigrid {

namespace {

using Relaxation = Ifpack2::Preconditioner<Scalar, LocalOrdinal, GlobalOrdinal, Node>;

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

constexpr int coarsest_schur = 200;  ///< unknowns

/// Coarse nodes for S from the graph of C, which is that of the mesh; S couples wider.
Teuchos::RCP<MixedCoarsening> coarsening_of(const Teuchos::RCP<CrsMatrix>& S,
                                            const Teuchos::RCP<const CrsMatrix>& nodes) {
  const auto order = Teuchos::rcp(new Vector(nodes->getRowMap()));
  for (const GlobalOrdinal row : nodes->getRowMap()->getNodeElementList())
    order->replaceGlobalValue(row, static_cast<Scalar>(row));
  fields::BlockMatrices scalar;  // both blocks are S: asked for one, it gives one
  scalar.A = scalar.mC = S;
  scalar.components = 1;
  scalar.vectors = scalar.scalars = {nodes, order};
  return Teuchos::rcp(new MixedCoarsening(scalar));
}

}  // namespace

struct BraessSarazin::Parts {
  Parts(const CrsMatrix& matrix, const MixedNumbering& numbering, const BraessSarazinOptions& o)
      : K(&matrix), options(o), blocks(matrix, numbering), inverse_D(blocks.diagonal->getMap()) {}

  const CrsMatrix* K;
  BraessSarazinOptions options;
  MixedBlocks blocks;
  Vector inverse_D;
  std::unique_ptr<SchurMatrix> S;
  Teuchos::RCP<Relaxation> rough;
  Teuchos::RCP<SparseLu> exact;
  std::unique_ptr<Cycle> cycle;

  /// Rows with nothing but the diagonal are solved, not smoothed.
  void invert_diagonal() {
    std::string problem;
    {
      const auto d = blocks.diagonal->getLocalViewHost(read_only);
      const auto inverse = inverse_D.getLocalViewHost(overwrite_all);
      for (std::size_t i = 0; i < d.extent(0); ++i) {
        if (!(std::abs(d(i, 0)) > 0.0)) problem = "Braess-Sarazin: no pivot on the diagonal of A.";
        inverse(i, 0) = 1.0 / ((blocks.is_lone[i] ? 1.0 : options.scaling) * d(i, 0));
      }
    }
    problem = agreed_message(*K->getComm(), problem);
    if (!problem.empty()) throw std::runtime_error(problem);
  }

  void solve_schur(const MultiVector& r, MultiVector& q) const {
    if (!rough.is_null()) return rough->apply(r, q);
    if (cycle) return cycle->apply(r, q);
    exact->setX(Teuchos::rcpFromRef(q));
    exact->setB(Teuchos::rcpFromRef(r));
    exact->solve();
  }
};

BraessSarazin::BraessSarazin(const CrsMatrix& K, const MixedNumbering& numbering,
                             const BraessSarazinOptions& options)
    : parts_(new Parts(K, numbering, options)) {
  Parts& parts = *parts_;
  parts.invert_diagonal();
  const MixedBlocks& blocks = parts.blocks;
  parts.S = std::make_unique<SchurMatrix>(*blocks.B1T, *blocks.B2, *blocks.mC, parts.inverse_D);
  if (options.schur == "multigrid") {
    parts.cycle =
        std::make_unique<Cycle>(parts.S->matrix(), coarsening_of(parts.S->matrix(), blocks.mC),
                                nodal_cycle_list(options.schur_sweeps, coarsest_schur));
    return;
  }
  if (options.schur != "direct") {
    parts.rough = relaxation(parts.S->matrix(), options);
    return;
  }
  parts.exact = make_sparse_lu(parts.S->matrix());
  refactor(*parts.exact, parts.S->matrix());
}

BraessSarazin::~BraessSarazin() = default;

void BraessSarazin::refresh() {
  Parts& parts = *parts_;
  parts.blocks.refresh();
  parts.invert_diagonal();
  parts.S->refresh(parts.inverse_D);
  if (!parts.rough.is_null()) return parts.rough->compute();
  if (parts.cycle) return parts.cycle->refresh();
  refactor(*parts.exact, parts.S->matrix());
}

void BraessSarazin::smooth(const MultiVector& b, MultiVector& x) const {
  const Parts& parts = *parts_;
  const MixedBlocks& blocks = parts.blocks;
  MultiVector r(b.getMap(), 1);
  Vector r_u(parts.inverse_D.getMap()), u(r_u.getMap());
  Vector r_p(blocks.mC->getRowMap()), q(r_p.getMap());
  for (int sweep = 0; sweep < parts.options.sweeps; ++sweep) {
    parts.K->apply(x, r);
    r.update(1.0, b, -1.0);
    blocks.split(r, r_u, r_p);
    u.elementWiseMultiply(1.0, parts.inverse_D, r_u, 0.0);
    blocks.B2->apply(u, r_p, Teuchos::NO_TRANS, 1.0, -1.0);  // B2 Ã⁻¹ r_u − r_p
    q.putScalar(0.0);
    parts.solve_schur(r_p, q);
    blocks.B1T->apply(q, r_u, Teuchos::NO_TRANS, -1.0, 1.0);
    u.elementWiseMultiply(1.0, parts.inverse_D, r_u, 0.0);
    blocks.add(parts.options.damping, u, q, x);
  }
}

}  // namespace tunica::multigrid
