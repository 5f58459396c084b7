#include "tunica/algebra/merged_matrix.hpp"

#include <algorithm>

#include "tunica/algebra/entry_offsets.hpp"
#include "tunica/base/trilinos.hpp"

namespace tunica::algebra {

namespace {

/// One block, with its rows and columns in numbers of the whole.
struct Part {
  const CrsMatrix* matrix;
  std::vector<GlobalOrdinal> rows, columns;

  Part(const CrsMatrix& block, bool has_scalar_rows, bool has_scalar_columns, const DofLayout& n)
      : matrix(&block), rows(mixed_numbers(*block.getRowMap(), has_scalar_rows, n)),
        columns(mixed_numbers(*block.getColMap(), has_scalar_columns, n)) {}

  void insert_graph(CrsMatrix& merged) const {
    const auto local = matrix->getLocalMatrixHost();
    std::vector<GlobalOrdinal> numbers;
    for (int i = 0; i < local.numRows(); ++i) {
      const auto row = local.rowConst(i);
      numbers.clear();
      for (int k = 0; k < row.length; ++k) numbers.push_back(columns[row.colidx(k)]);
      const std::vector<Scalar> zeros(numbers.size(), 0.0);
      merged.insertGlobalValues(rows[i], Teuchos::arrayViewFromVector(numbers),
                                Teuchos::arrayViewFromVector(zeros));
    }
  }

  std::vector<int> places(const CrsMatrix& merged) const {
    return entry_offsets(*matrix, rows, columns, merged);
  }
};

std::size_t longest_row(const BlockMatrices& K) {
  return std::max(longest_local_row(*K.A) + longest_local_row(*K.B1T),
                  longest_local_row(*K.B2) + longest_local_row(*K.mC));
}

}  // namespace

MergedMatrix::MergedMatrix(const BlockMatrices& K) : K_(&K) {
  const DofLayout numbering{K.components};
  const auto rows = numbering.mixed_map(*K.vector_map(), *K.scalar_map());
  matrix_ = Teuchos::rcp(new CrsMatrix(rows, longest_row(K)));
  const std::vector<Part> parts{{*K.A, false, false, numbering},
                                {*K.B1T, false, true, numbering},
                                {*K.B2, true, false, numbering},
                                {*K.mC, true, true, numbering}};
  for (const Part& part : parts) part.insert_graph(*matrix_);
  matrix_->fillComplete(rows, rows);
  for (const Part& part : parts) blocks_.push_back({part.matrix, part.places(*matrix_)});
  vector_rows_ = local_numbers(parts[0].rows, *rows);
  scalar_rows_ = local_numbers(parts[3].rows, *rows);
}

void MergedMatrix::refresh() {
  matrix_->resumeFill();
  {
    const auto values = matrix_->getLocalMatrixHost().values;
    for (const Block& block : blocks_) {
      const auto from = block.matrix->getLocalMatrixHost().values;
      for (std::size_t k = 0; k < block.places.size(); ++k) values(block.places[k]) = from(k);
    }
  }
  matrix_->fillComplete(matrix_->getDomainMap(), matrix_->getRangeMap());
}

void MergedMatrix::merge(const BlockVector& x, MultiVector& merged) const {
  const auto u = x.u->getLocalViewHost(read_only), p = x.p->getLocalViewHost(read_only);
  const auto all = merged.getLocalViewHost(overwrite_all);
  for (std::size_t i = 0; i < vector_rows_.size(); ++i) all(vector_rows_[i], 0) = u(i, 0);
  for (std::size_t i = 0; i < scalar_rows_.size(); ++i) all(scalar_rows_[i], 0) = p(i, 0);
}

void MergedMatrix::split(const MultiVector& merged, BlockVector& x) const {
  const auto all = merged.getLocalViewHost(read_only);
  const auto u = x.u->getLocalViewHost(overwrite_all), p = x.p->getLocalViewHost(overwrite_all);
  for (std::size_t i = 0; i < vector_rows_.size(); ++i) u(i, 0) = all(vector_rows_[i], 0);
  for (std::size_t i = 0; i < scalar_rows_.size(); ++i) p(i, 0) = all(scalar_rows_[i], 0);
}

}  // namespace tunica::algebra
