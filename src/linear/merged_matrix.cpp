#include "linear/merged_matrix.hpp"

#include "multigrid/expanded_map.hpp"

namespace tunica::linear {

MergedMatrix::MergedMatrix(const fields::BlockOperator& K) : K_(&K) {
  using RowStart = CrsMatrix::local_graph_device_type::row_map_type::non_const_type;
  using Columns = CrsMatrix::local_graph_device_type::entries_type::non_const_type;
  using Values = CrsMatrix::local_matrix_device_type::values_type::non_const_type;
  const fields::FieldMesh& mesh = K.mesh();
  const fields::NodeGraph& graph = K.graph();
  RowStart row_start("row start", static_cast<std::size_t>(4) * mesh.n_owned + 1);
  Columns columns("columns", 16 * graph.columns.size());
  Values values("values", 16 * graph.columns.size());
  std::size_t next = 0;
  for (int a = 0; a < mesh.n_owned; ++a)
    for (int c = 0; c < 4; ++c) {
      for (std::size_t k = graph.row_start[a]; k < graph.row_start[a + 1]; ++k)
        for (int d = 0; d < 4; ++d) columns(next++) = 4 * graph.columns[k] + d;
      row_start(4 * a + c + 1) = next;
    }
  const auto rows = multigrid::expanded_map(*mesh.node_map, 4);
  matrix_ = Teuchos::rcp(new CrsMatrix(rows, multigrid::expanded_map(*mesh.ghosted_map, 4),
                                       row_start, columns, values));
  matrix_->expertStaticFillComplete(rows, rows);
}

void MergedMatrix::refresh() {
  const fields::NodeGraph& graph = K_->graph();
  const auto A = K_->A->getLocalMatrixHost().values;
  const auto B1T = K_->B1T->getLocalMatrixHost().values;
  const auto B2 = K_->B2->getLocalMatrixHost().values;
  const auto mC = K_->mC->getLocalMatrixHost().values;
  matrix_->resumeFill();
  {
    const auto values = matrix_->getLocalMatrixHost().values;
    std::size_t next = 0;
    for (int a = 0; a < K_->mesh().n_owned; ++a) {
      const std::size_t start = graph.row_start[a];
      const std::size_t length = graph.row_start[a + 1] - start;
      for (int i = 0; i < 3; ++i)
        for (std::size_t k = 0; k < length; ++k) {
          const double* row = A.data() + 9 * start + 3 * length * i + 3 * k;
          for (int j = 0; j < 3; ++j) values(next++) = row[j];
          values(next++) = B1T(3 * start + length * i + k);
        }
      for (std::size_t k = 0; k < length; ++k) {
        for (int j = 0; j < 3; ++j) values(next++) = B2(3 * start + 3 * k + j);
        values(next++) = mC(start + k);
      }
    }
  }
  matrix_->fillComplete(matrix_->getDomainMap(), matrix_->getRangeMap());
}

void MergedMatrix::merge(const fields::BlockVector& x, MultiVector& merged) const {
  const auto u = x.u->getLocalViewHost(Tpetra::Access::ReadOnly);
  const auto p = x.p->getLocalViewHost(Tpetra::Access::ReadOnly);
  const auto all = merged.getLocalViewHost(Tpetra::Access::OverwriteAll);
  for (std::size_t a = 0; a < p.extent(0); ++a) {
    for (int i = 0; i < 3; ++i) all(4 * a + i, 0) = u(3 * a + i, 0);
    all(4 * a + 3, 0) = p(a, 0);
  }
}

void MergedMatrix::split(const MultiVector& merged, fields::BlockVector& x) const {
  const auto all = merged.getLocalViewHost(Tpetra::Access::ReadOnly);
  const auto u = x.u->getLocalViewHost(Tpetra::Access::OverwriteAll);
  const auto p = x.p->getLocalViewHost(Tpetra::Access::OverwriteAll);
  for (std::size_t a = 0; a < p.extent(0); ++a) {
    for (int i = 0; i < 3; ++i) u(3 * a + i, 0) = all(4 * a + i, 0);
    p(a, 0) = all(4 * a + 3, 0);
  }
}

}  // namespace tunica::linear
