#pragma once
#include <cstddef>
#include <functional>
#include <utility>
#include <vector>

#include "tunica/base/reduce.hpp"
#include "tunica/base/rows.hpp"
#include "tunica/base/types.hpp"

namespace tunica::systems {

/// Number of entries that are read, computed or sent at once. Messages of a megabyte are long
/// enough, and small beside a rank's rows.
constexpr std::size_t entries_at_once = std::size_t{1} << 16;

/// Where the entries of a sparse matrix stand, in the portion of its rows that a rank has
/// (base/portion.hpp). Rows and columns are counted from 0.
struct SparseRows {
  CommPtr comm;
  long long n_rows = 0, n_columns = 0;  ///< of all ranks
  std::vector<std::size_t> start{0};    ///< size: rows of the rank + 1
  std::vector<long long> columns;

  long long first_row() const { return portion_of(n_rows, *comm).first; }
  std::size_t n_local_rows() const { return start.size() - 1; }
};

struct MatrixRows : SparseRows {
  std::vector<double> values;
};

struct Entry {
  long long row, column;
  double value;
};

/// Takes entries, which come in any order on any rank, to the ranks that have their rows.
class RowCollector {
public:
  RowCollector(long long n_rows, long long n_columns, const CommPtr& comm);
  /// Collective.
  void add(const std::vector<Entry>& entries);
  /// Rows in ascending order. Duplicate entries are summed in the order of their arrival. Leaves no
  /// rows.
  MatrixRows take();

private:
  MatrixRows rows_;
  std::vector<std::vector<Entry>> pieces_;
};

/// Without an entry. Collective.
MatrixRows empty_matrix(long long n_rows, long long n_columns, const CommPtr& comm);
/// Collective.
MatrixRows transposed(const MatrixRows& A);
/// Factors need a diagonal even where it is zero.
MatrixRows with_diagonal(const MatrixRows& A);
/// Diagonal entries of the rank's rows; 0 if there is none.
std::vector<double> diagonal(const MatrixRows& A);

/// What stands in each column of the rank's portion of columns: value(row, k) of every entry k in a
/// local row of any rank, combined from 0 on. Collective.
std::vector<double> over_columns(const MatrixRows& A,
                                 const std::function<double(std::size_t, std::size_t)>& value,
                                 const std::function<double(double, double)>& combine);

/// The entries of these ascending rows, which any ranks have, in their order. Collective.
std::vector<Entry> fetch_rows(const MatrixRows& A, const std::vector<long long>& rows);

/// Every column of these rows of the rank once, ascending.
std::vector<long long> columns_of(const SparseRows& A, std::size_t first, std::size_t last);
inline std::vector<long long> columns_of(const SparseRows& A) {
  return columns_of(A, 0, A.n_local_rows());
}

/// Items of which each rank has a portion, where a rank needs some of them.
template <class Item>
class Fetched {
public:
  /// mine: the items of the rank's portion. numbers: those that are needed, ascending. Collective.
  Fetched(const Comm& comm, std::vector<long long> numbers, const std::vector<Item>& mine,
          long long total)
      : numbers_(std::move(numbers)), items_(fetch(comm, numbers_, mine, total)) {}
  const Item& operator()(long long number) const { return items_[place_of(number, numbers_)]; }

private:
  std::vector<long long> numbers_;
  std::vector<Item> items_;
};

/// Work with collective calls in it on the rank's rows from first to last, a few after the other:
/// as often on all ranks, on some perhaps without a row. Collective.
template <class Work>
void in_batches(const SparseRows& A, const Work& work) {
  std::size_t first = 0;
  while (!all_agree(*A.comm, first == A.n_local_rows())) {
    std::size_t last = first;
    while (last < A.n_local_rows() && A.start[last] - A.start[first] < entries_at_once) ++last;
    work(first, last);
    first = last;
  }
}

}  // namespace tunica::systems
