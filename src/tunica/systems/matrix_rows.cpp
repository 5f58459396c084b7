#include "tunica/systems/matrix_rows.hpp"

#include <algorithm>

#include "tunica/base/exchange.hpp"
#include "tunica/base/sort_once.hpp"

namespace tunica::systems {

namespace {

using Place = std::pair<long long, double>;  ///< column, value

/// Sorts the entries of each row and adds up those of the same column.
void sort_rows(MatrixRows& A) {
  std::vector<Place> row;
  std::size_t end = 0, first = 0;
  for (std::size_t i = 0; i < A.n_local_rows(); ++i) {
    row.clear();
    for (std::size_t k = first; k < A.start[i + 1]; ++k)
      row.emplace_back(A.columns[k], A.values[k]);
    first = A.start[i + 1];
    std::stable_sort(row.begin(), row.end(),
                     [](const Place& a, const Place& b) { return a.first < b.first; });
    for (const auto& [column, value] : row) {
      if (end > A.start[i] && A.columns[end - 1] == column) {
        A.values[end - 1] += value;
        continue;
      }
      A.columns[end] = column;
      A.values[end++] = value;
    }
    A.start[i + 1] = end;
  }
  A.columns.resize(end);
  A.values.resize(end);
}

}  // namespace

RowCollector::RowCollector(long long n_rows, long long n_columns, const CommPtr& comm)
    : rows_(empty_matrix(n_rows, n_columns, comm)) {}

void RowCollector::add(const std::vector<Entry>& entries) {
  const Comm& comm = *rows_.comm;
  std::vector<int> ranks;
  ranks.reserve(entries.size());
  for (const Entry& entry : entries) ranks.push_back(rank_of_row(entry.row, rows_.n_rows, comm));
  pieces_.push_back(exchange_to(comm, entries, ranks).items);
}

MatrixRows RowCollector::take() {
  const long long first = rows_.first_row();
  for (const auto& piece : pieces_)
    for (const Entry& entry : piece) ++rows_.start[entry.row - first + 1];
  for (std::size_t i = 0; i < rows_.n_local_rows(); ++i) rows_.start[i + 1] += rows_.start[i];
  rows_.columns.resize(rows_.start.back());
  rows_.values.resize(rows_.start.back());
  std::vector<std::size_t> next(rows_.start.begin(), rows_.start.end() - 1);
  for (const auto& piece : pieces_)
    for (const Entry& entry : piece) {
      const std::size_t place = next[entry.row - first]++;
      rows_.columns[place] = entry.column;
      rows_.values[place] = entry.value;
    }
  pieces_.clear();
  sort_rows(rows_);
  return std::exchange(rows_, {});
}

MatrixRows empty_matrix(long long n_rows, long long n_columns, const CommPtr& comm) {
  MatrixRows A;
  A.comm = comm;
  A.n_rows = n_rows;
  A.n_columns = n_columns;
  A.start.assign(static_cast<std::size_t>(portion_of(n_rows, *comm).count) + 1, 0);
  return A;
}

MatrixRows transposed(const MatrixRows& A) {
  RowCollector collector(A.n_columns, A.n_rows, A.comm);
  in_batches(A, [&](std::size_t first, std::size_t last) {
    std::vector<Entry> entries;
    for (std::size_t i = first; i < last; ++i)
      for (std::size_t k = A.start[i]; k < A.start[i + 1]; ++k)
        entries.push_back({A.columns[k], A.first_row() + static_cast<long long>(i), A.values[k]});
    collector.add(entries);
  });
  return collector.take();
}

MatrixRows with_diagonal(const MatrixRows& A) {
  MatrixRows result = empty_matrix(A.n_rows, A.n_columns, A.comm);
  result.columns.reserve(A.columns.size());
  result.values.reserve(A.values.size());
  const auto add = [&result](long long column, double value) {
    result.columns.push_back(column);
    result.values.push_back(value);
  };
  for (std::size_t i = 0; i < A.n_local_rows(); ++i) {
    const long long row = A.first_row() + static_cast<long long>(i);
    bool is_missing = true;
    for (std::size_t k = A.start[i]; k < A.start[i + 1]; ++k) {
      if (is_missing && A.columns[k] >= row) {
        if (A.columns[k] > row) add(row, 0.0);
        is_missing = false;
      }
      add(A.columns[k], A.values[k]);
    }
    if (is_missing) add(row, 0.0);
    result.start[i + 1] = result.columns.size();
  }
  return result;
}

std::vector<double> diagonal(const MatrixRows& A) {
  std::vector<double> result(A.n_local_rows(), 0.0);
  for (std::size_t i = 0; i < A.n_local_rows(); ++i)
    for (std::size_t k = A.start[i]; k < A.start[i + 1]; ++k)
      if (A.columns[k] == A.first_row() + static_cast<long long>(i)) result[i] = A.values[k];
  return result;
}

std::vector<double> over_columns(const MatrixRows& A,
                                 const std::function<double(std::size_t, std::size_t)>& value,
                                 const std::function<double(double, double)>& combine) {
  struct OfColumn {
    long long column;
    double value;
  };
  // Those of this rank's rows first: a column of them is sent once.
  const std::vector<long long> columns = columns_of(A);
  std::vector<OfColumn> mine;
  std::vector<int> ranks;
  for (const long long column : columns) {
    mine.push_back({column, 0.0});
    ranks.push_back(rank_of_row(column, A.n_columns, *A.comm));
  }
  for (std::size_t i = 0; i < A.n_local_rows(); ++i)
    for (std::size_t k = A.start[i]; k < A.start[i + 1]; ++k) {
      double& sum = mine[place_of(A.columns[k], columns)].value;
      sum = combine(sum, value(i, k));
    }
  const Portion portion = portion_of(A.n_columns, *A.comm);
  std::vector<double> all(static_cast<std::size_t>(portion.count), 0.0);
  for (const OfColumn& one : exchange_to(*A.comm, mine, ranks).items) {
    double& sum = all[one.column - portion.first];
    sum = combine(sum, one.value);
  }
  return all;
}

std::vector<Entry> fetch_rows(const MatrixRows& A, const std::vector<long long>& rows) {
  const Comm& comm = *A.comm;
  const Received<long long> asked = exchange(comm, rows, rows_by_rank(comm, rows, A.n_rows));
  std::vector<Entry> answers;
  std::vector<int> counts;
  auto row = asked.items.begin();
  for (const int count : asked.counts) {
    const std::size_t before = answers.size();
    for (const auto end = row + count; row != end; ++row) {
      const long long i = *row - A.first_row();
      for (std::size_t k = A.start[i]; k < A.start[i + 1]; ++k)
        answers.push_back({*row, A.columns[k], A.values[k]});
    }
    counts.push_back(static_cast<int>(answers.size() - before));
  }
  return exchange(comm, answers, counts).items;
}

// Where entries are many for all columns a mark for each of these takes less time than to sort.
std::vector<long long> columns_of(const SparseRows& A, std::size_t first, std::size_t last) {
  const auto begin = A.columns.begin() + static_cast<std::ptrdiff_t>(A.start[first]);
  const auto end = A.columns.begin() + static_cast<std::ptrdiff_t>(A.start[last]);
  if (end - begin < A.n_columns / 16) {
    Once<long long> columns;
    std::for_each(begin, end, [&](long long column) { columns.add(column); });
    return columns.take();
  }
  std::vector<char> is_there(static_cast<std::size_t>(A.n_columns), 0);
  std::for_each(begin, end, [&](long long column) { is_there[column] = 1; });
  std::vector<long long> columns;
  for (std::size_t column = 0; column < is_there.size(); ++column)
    if (is_there[column] != 0) columns.push_back(static_cast<long long>(column));
  return columns;
}

}  // namespace tunica::systems
