#include "tunica/multigrid/muelu/transfer_matrix.hpp"

#include "tunica/base/trilinos.hpp"

namespace tunica::multigrid {

namespace {

/// Where the rows of a local matrix are, not to be looked up again after each number stored.
struct Rows {
  const CrsMatrix::local_matrix_host_type::size_type* start;
  const int* columns;
  const double* values;
  int size;

  explicit Rows(const CrsMatrix& P) {
    const auto local = P.getLocalMatrixHost();
    start = local.graph.row_map.data();
    columns = local.graph.entries.data();
    values = local.values.data();
    size = static_cast<int>(local.numRows());
  }
};

// y_i ← y_i + α Σ_j P_ij x_j
void add_product(const CrsMatrix& P, const MultiVector& X, MultiVector& Y, Scalar alpha) {
  const auto importer = P.getGraph()->getImporter();
  Teuchos::RCP<const MultiVector> on_columns = Teuchos::rcpFromRef(X);
  if (!importer.is_null()) {
    const auto fetched = Teuchos::rcp(new MultiVector(P.getColMap(), X.getNumVectors(), false));
    fetched->doImport(X, *importer, insert);
    on_columns = fetched;
  }
  const Rows rows(P);
  const auto x = on_columns->getLocalViewHost(read_only);
  const auto y = Y.getLocalViewHost(read_write);
  for (std::size_t c = 0; c < Y.getNumVectors(); ++c) {
    const double* const from = &x(0, c);
    double* const to = &y(0, c);
    for (int i = 0; i < rows.size; ++i) {
      double sum = 0.0;
      for (auto k = rows.start[i]; k < rows.start[i + 1]; ++k)
        sum += rows.values[k] * from[rows.columns[k]];
      to[i] += alpha * sum;
    }
  }
}

// y_j ← y_j + α Σ_i P_ij x_i
void add_transposed_product(const CrsMatrix& P, const MultiVector& X, MultiVector& Y,
                            Scalar alpha) {
  const auto importer = P.getGraph()->getImporter();
  Teuchos::RCP<MultiVector> on_columns = Teuchos::rcpFromRef(Y);
  if (!importer.is_null())
    on_columns = Teuchos::rcp(new MultiVector(P.getColMap(), X.getNumVectors()));
  {
    const Rows rows(P);
    const auto x = X.getLocalViewHost(read_only);
    const auto y = on_columns->getLocalViewHost(read_write);
    for (std::size_t c = 0; c < X.getNumVectors(); ++c) {
      const double* const from = &x(0, c);
      double* const to = &y(0, c);
      for (int i = 0; i < rows.size; ++i) {
        const double x_i = alpha * from[i];
        for (auto k = rows.start[i]; k < rows.start[i + 1]; ++k)
          to[rows.columns[k]] += rows.values[k] * x_i;
      }
    }
  }
  // ADD would overwrite what Y has of its own.
  if (!importer.is_null()) Y.doExport(*on_columns, *importer, Tpetra::ADD_ASSIGN);
}

}  // namespace

TransferMatrix::TransferMatrix(const Teuchos::RCP<::tunica::CrsMatrix>& matrix)
    : CrsMatrixWrap(Teuchos::rcp_dynamic_cast<CrsMatrixWrap>(wrapped(matrix))->getCrsMatrix()),
      P_(matrix) {}

// Rows are on the ranks of the vectors; columns of other ranks come by the importer, which takes
// sums for them back in the transpose.
void TransferMatrix::apply(const XMultiVector& X, XMultiVector& Y, Teuchos::ETransp mode,
                           Scalar alpha, Scalar beta) const {
  if (!P_->getGraph()->getExporter().is_null() || mode == Teuchos::CONJ_TRANS)
    return CrsMatrixWrap::apply(X, Y, mode, alpha, beta);
  const auto x = unwrapped(X);
  const auto y = unwrapped(Y);
  if (beta == 0.0)
    y->putScalar(0.0);
  else if (beta != 1.0)
    y->scale(beta);
  if (mode == Teuchos::NO_TRANS)
    add_product(*P_, *x, *y, alpha);
  else
    add_transposed_product(*P_, *x, *y, alpha);
}

}  // namespace tunica::multigrid
