#include "tunica/algebra/products/triple_product.hpp"

#include <algorithm>
#include <numeric>
#include <stdexcept>

#include "tunica/algebra/entry_offsets.hpp"
#include "tunica/algebra/static_matrix.hpp"
#include "tunica/base/map_of.hpp"
#include "tunica/base/reduce.hpp"
#include "tunica/base/trilinos.hpp"

namespace tunica::algebra {

namespace {

/// The column of A that each of its rows has the number of, -1 where it has none.
std::vector<int> diagonal_of(const CrsMatrix& A) {
  std::vector<int> columns;
  for (const GlobalOrdinal row : global_numbers(*A.getRowMap()))
    columns.push_back(A.getColMap()->getLocalElement(row));
  return columns;
}

/// Some rows of the kernel's matrix under these numbers, all zero.
Teuchos::RCP<CrsMatrix> rows_of(const TripleKernel& kernel, const std::vector<int>& rows,
                                const Teuchos::RCP<const Map>& numbers, const CrsMatrix& P) {
  const auto& row_start = kernel.row_start();
  RowStart start("row start", rows.size() + 1);
  for (std::size_t i = 0; i < rows.size(); ++i)
    start(i + 1) = start(i) + row_start[rows[i] + 1] - row_start[rows[i]];
  LocalColumns columns("columns", start(rows.size()));
  for (std::size_t i = 0; i < rows.size(); ++i)
    std::copy(kernel.columns().data() + row_start[rows[i]],
              kernel.columns().data() + row_start[rows[i] + 1], columns.data() + start(i));
  return matrix_on(static_graph(numbers, P.getColMap(), start, columns, P.getDomainMap()));
}

/// Where these rows of the kernel have their values in a matrix that has them one after the other.
void set_places(const CrsMatrix& matrix, const std::vector<int>& rows,
                std::vector<double*>& places) {
  const auto local = matrix.getLocalMatrixHost();
  std::fill_n(local.values.data(), local.values.extent(0), 0.0);
  for (std::size_t i = 0; i < rows.size(); ++i)
    places[rows[i]] = local.values.data() + local.graph.row_map(i);
}

bool numbers_columns_as_rows(const CrsMatrix& A) {
  return A.getComm()->getSize() == 1 && A.getColMap()->isSameAs(*A.getRowMap());
}

}  // namespace

bool TripleProduct::serves(const CrsMatrix& A, const CrsMatrix& P) {
  const auto diagonal = diagonal_of(A);
  const bool has_all = std::find(diagonal.begin(), diagonal.end(), -1) == diagonal.end();
  return all_agree(*A.getComm(), has_all) && A.getRowMap()->isSameAs(*A.getDomainMap()) &&
         A.getRowMap()->isSameAs(*P.getRowMap());
}

TripleProduct::TripleProduct(const CrsMatrix& A, const CrsMatrix& P) : A_(&A), P_(&P) {
  if (!serves(A, P)) throw std::invalid_argument("TripleProduct: not for these matrices");
  if (!numbers_columns_as_rows(A)) fetch_rows();
  kernel_.emplace(A.getLocalMatrixHost().graph, P_->getLocalMatrixHost().graph, diagonal_of(A),
                  static_cast<int>(n_local(*P_->getColMap())));
  own_rows_.resize(n_local(*P_->getColMap()));
  std::iota(own_rows_.begin(), own_rows_.end(), 0);
  if (A.getComm()->getSize() == 1 && P_->getColMap()->isSameAs(*P_->getDomainMap()))
    product_ = rows_of(*kernel_, own_rows_, P_->getDomainMap(), *P_);
  else
    join_ranks();
  kernel_->forget_columns();
}

void TripleProduct::fetch_rows() {
  const Import import(P_->getRowMap(), A_->getColMap());
  fetched_ = Teuchos::rcp(new CrsMatrix(A_->getColMap(), P_->getGlobalMaxNumRowEntries()));
  fetched_->doImport(*P_, import, insert);
  fetched_->fillComplete(P_->getDomainMap(), P_->getRangeMap());
  P_ = fetched_.get();
}

// Rows that are sent and those of their owners make a graph that has all entries of both.
void TripleProduct::join_ranks() {
  const Map& columns = *P_->getColMap();
  const auto owners = P_->getDomainMap();
  std::vector<GlobalOrdinal> own, others;
  own_rows_.clear();
  Vector lengths(P_->getColMap()), summed(owners);
  for (int c = 0; c < static_cast<int>(n_local(columns)); ++c) {
    const GlobalOrdinal number = columns.getGlobalElement(c);
    const auto length = kernel_->row_start()[c + 1] - kernel_->row_start()[c];
    lengths.replaceLocalValue(c, static_cast<double>(length));
    const bool is_own = owners->isNodeGlobalElement(number);
    if (!is_own && length == 0) continue;
    (is_own ? own : others).push_back(number);
    (is_own ? own_rows_ : other_rows_).push_back(c);
  }
  own_ = rows_of(*kernel_, own_rows_, map_of(own, A_->getComm()), *P_);
  others_ = rows_of(*kernel_, other_rows_, map_of(others, A_->getComm()), *P_);
  using Export = Tpetra::Export<LocalOrdinal, GlobalOrdinal, Node>;
  summed.doExport(lengths, Export(P_->getColMap(), owners), Tpetra::ADD);
  to_owners_ = Teuchos::rcp(new Export(others_->getRowMap(), owners));
  CrsMatrix joined(owners, static_cast<std::size_t>(summed.normInf()));
  joined.doExport(*own_, Export(own_->getRowMap(), owners), Tpetra::ADD);
  joined.doExport(*others_, *to_owners_, Tpetra::ADD);
  joined.fillComplete(owners, owners);
  product_ = matrix_on(joined.getCrsGraph());
  own_offsets_ = entry_offsets(*own_, *product_);
}

void TripleProduct::refresh() {
  std::vector<double*> places(n_local(*P_->getColMap()), nullptr);
  product_->resumeFill();
  set_places(own_.is_null() ? *product_ : *own_, own_rows_, places);
  if (!others_.is_null()) set_places(*others_, other_rows_, places);
  kernel_->add(A_->getLocalMatrixHost(), P_->getLocalMatrixHost(), places);
  if (!own_.is_null()) {
    product_->setAllToScalar(0.0);
    {
      const auto from = own_->getLocalMatrixHost().values;
      const auto to = product_->getLocalMatrixHost().values;
      for (std::size_t k = 0; k < own_offsets_.size(); ++k) to(own_offsets_[k]) = from(k);
    }
    product_->doExport(*others_, *to_owners_, Tpetra::ADD);
  }
  product_->fillComplete(product_->getDomainMap(), product_->getRangeMap());
}

}  // namespace tunica::algebra
