#include "tunica/systems/matrix_files.hpp"

#include <MatrixMarket_Tpetra.hpp>
#include <Teuchos_DefaultSerialComm.hpp>
#include <algorithm>
#include <cmath>

#include "tunica/base/error.hpp"
#include "tunica/base/exception_summary.hpp"
#include "tunica/base/out_of_memory.hpp"

namespace tunica::systems {

namespace {

using Reader = Tpetra::MatrixMarket::Reader<CrsMatrix>;

CommPtr alone() { return Teuchos::rcp(new Teuchos::SerialComm<int>); }

template <class Read>
auto reading(const std::string& path, const Read& read) {
  try {
    return read();
  } catch (const std::exception& error) {
    if (is_out_of_memory(error)) throw;
    const std::string cause =
        exception_summary(error.what());  // ends with files of Trilinos itself
    throw Error(path +
                ": no Matrix Market file that can be read: " + cause.substr(0, cause.find(": /")));
  }
}

}  // namespace

FileMatrix read_matrix(const std::string& path) {
  const auto matrix = reading(path, [&] { return Reader::readSparseFile(path, alone()); });
  const auto local = matrix->getLocalMatrixHost();
  FileMatrix A =
      empty_matrix(static_cast<long long>(matrix->getGlobalNumRows()),
                   static_cast<long long>(matrix->getDomainMap()->getGlobalNumElements()));
  std::vector<std::pair<long long, double>> entries;
  for (int i = 0; i < local.numRows(); ++i) {
    const auto row = local.rowConst(i);
    entries.clear();
    for (int k = 0; k < row.length; ++k) {
      TUNICA_CHECK(std::isfinite(row.value(k)),
                   path + ": an entry of row " + std::to_string(i + 1) + " is not finite.");
      entries.emplace_back(matrix->getColMap()->getGlobalElement(row.colidx(k)), row.value(k));
    }
    std::sort(entries.begin(), entries.end());
    for (const auto& [column, value] : entries) {
      A.columns.push_back(column);
      A.values.push_back(value);
    }
    A.start[i + 1] = A.columns.size();
  }
  return A;
}

std::vector<double> read_column(const std::string& path) {
  Teuchos::RCP<const Map> map;  // the reader makes one
  const auto vector = reading(path, [&] { return Reader::readDenseFile(path, alone(), map); });
  TUNICA_CHECK(vector->getNumVectors() == 1,
               path + ": " + std::to_string(vector->getNumVectors()) + " columns, expected one.");
  const auto values = vector->getLocalViewHost(read_only);
  std::vector<double> column(values.extent(0));
  for (std::size_t i = 0; i < column.size(); ++i) column[i] = values(i, 0);
  return column;
}

FileMatrix empty_matrix(long long n_rows, long long n_columns) {
  FileMatrix A;
  A.n_rows = n_rows;
  A.n_columns = n_columns;
  A.start.assign(static_cast<std::size_t>(n_rows) + 1, 0);
  return A;
}

FileMatrix transposed(const FileMatrix& A) {
  FileMatrix T = empty_matrix(A.n_columns, A.n_rows);
  for (const long long column : A.columns) ++T.start[column + 1];
  for (std::size_t i = 0; i + 1 < T.start.size(); ++i) T.start[i + 1] += T.start[i];
  std::vector<std::size_t> next(T.start.begin(), T.start.end() - 1);
  T.columns.resize(A.columns.size());
  T.values.resize(A.values.size());
  for (long long i = 0; i < A.n_rows; ++i)
    for (std::size_t k = A.start[i]; k < A.start[i + 1]; ++k) {
      const std::size_t place = next[A.columns[k]]++;
      T.columns[place] = i;
      T.values[place] = A.values[k];
    }
  return T;
}

}  // namespace tunica::systems
