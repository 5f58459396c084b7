#include "tunica/algebra/products/grouped_matrix.hpp"

#include "tunica/algebra/products/groups.hpp"
#include "tunica/base/pack.hpp"

namespace tunica::algebra {

namespace {

static_assert(Groups::most == Pack::size);
constexpr int width = Pack::size;

/// Rows of a group, with the same columns.
struct Rows {
  const int* columns;
  std::size_t length;
  const double* values;  ///< row behind row
};

double sum_of(const Pack& a) { return (a[0] + a[1]) + (a[2] + a[3]); }

/// y_r = Σ_k A_rk x_k of n rows, by four columns that follow each other where there are such.
template <int n>
inline void multiply(const Rows& rows, const double* x, double* y) {
  Pack sums[n];
  double rest[n];
  for (int r = 0; r < n; ++r) {
    sums[r] = 0.0;
    rest[r] = 0.0;
  }
  std::size_t k = 0;
  while (k < rows.length) {
    const int column = rows.columns[k];
    // Columns ascend: the fourth one tells of those between.
    if (k + width <= rows.length && rows.columns[k + width - 1] == column + width - 1) {
      const Pack x_k = Pack::load(x + column);
      for (int r = 0; r < n; ++r) sums[r] += Pack::load(rows.values + r * rows.length + k) * x_k;
      k += width;
    } else {
      for (int r = 0; r < n; ++r) rest[r] += rows.values[r * rows.length + k] * x[column];
      ++k;
    }
  }
  for (int r = 0; r < n; ++r) y[r] = sum_of(sums[r]) + rest[r];
}

TUNICA_PACKED void multiply_all(const std::vector<int>& start,
                                const CrsMatrix::local_matrix_host_type& A, const double* x,
                                double* y) {
  for (std::size_t g = 0; g + 1 < start.size(); ++g) {
    const int first = start[g];
    const auto begin = A.graph.row_map(first);
    const Rows rows{A.graph.entries.data() + begin, A.graph.row_map(first + 1) - begin,
                    A.values.data() + begin};
    switch (start[g + 1] - first) {
      case 4:
        multiply<4>(rows, x, y + first);
        break;
      case 3:
        multiply<3>(rows, x, y + first);
        break;
      case 2:
        multiply<2>(rows, x, y + first);
        break;
      default:
        multiply<1>(rows, x, y + first);
    }
  }
}

}  // namespace

GroupedMatrix::GroupedMatrix(const Teuchos::RCP<const CrsMatrix>& A) : A_(A) {
  const auto graph = A->getLocalMatrixHost().graph;
  start_ = groups_of_rows(
               n_rows(graph), [&](int i) { return graph.row_map(i); }, graph.entries.data())
               .start;
}

void GroupedMatrix::apply(const MultiVector& X, MultiVector& Y, Teuchos::ETransp mode, Scalar alpha,
                          Scalar beta) const {
  const bool is_product = mode == Teuchos::NO_TRANS && alpha == 1.0 && beta == 0.0;
  const bool has_own_rows = A_->getCrsGraph()->getExporter().is_null();
  if (!is_product || !has_own_rows || X.getNumVectors() != 1 || &X == &Y)
    return A_->apply(X, Y, mode, alpha, beta);
  const auto importer = A_->getCrsGraph()->getImporter();
  if (importer.is_null()) {
    multiply_all(start_, A_->getLocalMatrixHost(), X.getLocalViewHost(read_only).data(),
                 Y.getLocalViewHost(overwrite_all).data());
    return;
  }
  MultiVector columns(A_->getColMap(), 1);
  columns.doImport(X, *importer, insert);
  multiply_all(start_, A_->getLocalMatrixHost(), columns.getLocalViewHost(read_only).data(),
               Y.getLocalViewHost(overwrite_all).data());
}

}  // namespace tunica::algebra
