#include <Teuchos_UnitTestHarness.hpp>

#include "tunica/base/trilinos.hpp"
#include "tunica/linear/block_preconditioner.hpp"
#include "unit/linear/strategies.hpp"

namespace {

using namespace tunica;

using Row = std::vector<std::pair<GlobalOrdinal, double>>;

/// A matrix with these rows.
template <class RowOf>
Teuchos::RCP<CrsMatrix> matrix(const Teuchos::RCP<const Map>& rows,
                               const Teuchos::RCP<const Map>& columns, const RowOf& row_of) {
  const auto A = Teuchos::rcp(new CrsMatrix(rows, 3));
  for (const GlobalOrdinal row : global_numbers(*rows)) {
    for (const auto& [column, value] : row_of(row))
      A->insertGlobalValues(row, Teuchos::tuple(column), Teuchos::tuple(value));
  }
  A->fillComplete(columns, rows);
  return A;
}

/// A ring of nodes with two vector unknowns and a scalar each. The components do not see each
/// other: a row of A has 3 on the diagonal and −1 at its two neighbours, so that the sum over its
/// own component is 1. B2 adds the two unknowns of a node, C = 1.
algebra::BlockMatrix ring() {
  const CommPtr comm = Tpetra::getDefaultComm();
  const GlobalOrdinal n = 4 * comm->getSize();
  const auto nodes = Teuchos::rcp(new Map(n, 0, comm)),
             vectors = Teuchos::rcp(new Map(2 * n, 0, comm));
  const auto stencil = [](GlobalOrdinal row, GlobalOrdinal step, GlobalOrdinal size) {
    return Row{{row, 3.0}, {(row + step) % size, -1.0}, {(row + size - step) % size, -1.0}};
  };
  const auto order = Teuchos::rcp(new Vector(nodes));
  for (LocalOrdinal i = 0; i < static_cast<LocalOrdinal>(order->getLocalLength()); ++i)
    order->replaceLocalValue(i, static_cast<double>(nodes->getGlobalElement(i)));
  const algebra::Nodes graph{
      matrix(nodes, nodes, [&](GlobalOrdinal row) { return stencil(row, 1, n); })->getCrsGraph(),
      order};
  algebra::BlockMatrix K(std::make_shared<const algebra::BlockSpace>(
      std::vector<algebra::Block>{{"velocity", vectors, 2, graph}, {"pressure", nodes, 1, graph}}));
  K.set(0, 0, matrix(vectors, vectors, [&](GlobalOrdinal row) { return stencil(row, 2, 2 * n); }));
  K.set(0, 1, matrix(vectors, nodes, [](GlobalOrdinal row) { return Row{{row / 2, 1.0}}; }));
  K.set(1, 0, matrix(nodes, vectors, [](GlobalOrdinal row) {
          return Row{{2 * row, 1.0}, {2 * row + 1, 1.0}};
        }));
  K.set(1, 1, matrix(nodes, nodes, [](GlobalOrdinal row) { return Row{{row, -1.0}}; }));
  return K;
}

/// "Schur Mass" = 1.
class UnitMass final : public linear::NamedOperators {
public:
  explicit UnitMass(const algebra::BlockMatrix& K) : map_((*K.space())[1].map) {}
  std::vector<std::string> operator_names() const override { return {"Schur Mass"}; }
  Teuchos::RCP<const CrsMatrix> assemble_operator(const std::string&) const override {
    return matrix(map_, map_, [](GlobalOrdinal row) { return Row{{row, 1.0}}; });
  }

private:
  Teuchos::RCP<const Map> map_;
};

// S̃⁻¹ = (C + B2 D⁻¹ B1ᵀ)⁻¹ + (C + M)⁻¹ = 1/(1 + 1 + 1) + 1/(1 + 1), and LU Upper gives −S̃⁻¹.
TEUCHOS_UNIT_TEST(schur, inertia_is_lumped_per_component_also_where_there_are_two) {
  const algebra::BlockMatrix K = ring();
  const UnitMass operators(K);
  linear::BlockPreconditioner P(test::strategy("LU Upper", "Two Scale"), K, operators);
  P.refresh();
  const algebra::Concatenation blocks(K.space());
  MultiVector r(blocks.map(), 1), z(blocks.map(), 1);
  blocks.parts(r)[1]->putScalar(6.0);
  P.apply(r, z);
  const auto pressures = blocks.parts(z)[1];
  for (const double p : pressures->getData(0)) TEST_FLOATING_EQUALITY(p, -5.0, 1e-12);
}

}  // namespace
