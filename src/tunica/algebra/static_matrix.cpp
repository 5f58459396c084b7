#include "tunica/algebra/static_matrix.hpp"

namespace tunica::algebra {

Teuchos::RCP<CrsGraph> static_graph(const Teuchos::RCP<const Map>& rows,
                                    const Teuchos::RCP<const Map>& with_ghosts,
                                    const RowStart& row_start, const LocalColumns& columns,
                                    const Teuchos::RCP<const Map>& domain) {
  const auto graph = Teuchos::rcp(new CrsGraph(rows, with_ghosts, row_start, columns));
  graph->expertStaticFillComplete(domain, rows);
  return graph;
}

Teuchos::RCP<CrsMatrix> matrix_on(const Teuchos::RCP<const CrsGraph>& graph, Scalar value) {
  const auto matrix = Teuchos::rcp(new CrsMatrix(graph));
  matrix->setAllToScalar(value);
  matrix->fillComplete(graph->getDomainMap(), graph->getRangeMap());
  return matrix;
}

}  // namespace tunica::algebra
