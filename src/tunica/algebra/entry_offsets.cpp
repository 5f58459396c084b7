#include "tunica/algebra/entry_offsets.hpp"

#include <algorithm>
#include <stdexcept>

#include "tunica/base/trilinos.hpp"

namespace tunica::algebra {

namespace {

std::vector<GlobalOrdinal> numbers_of(const Map& map) {
  const auto list = global_numbers(map);
  return {list.begin(), list.end()};
}

}  // namespace

std::vector<int> local_numbers(const std::vector<GlobalOrdinal>& numbers, const Map& map) {
  std::vector<int> local;
  local.reserve(numbers.size());
  for (const GlobalOrdinal number : numbers) local.push_back(map.getLocalElement(number));
  return local;
}

std::vector<int> entry_offsets(const CrsMatrix& part, const std::vector<GlobalOrdinal>& rows,
                               const std::vector<GlobalOrdinal>& columns, const CrsMatrix& whole) {
  const auto from = part.getLocalMatrixHost();
  const auto graph = whole.getLocalMatrixHost().graph;
  const std::vector<int> to_rows = local_numbers(rows, *whole.getRowMap());
  const std::vector<int> to_columns = local_numbers(columns, *whole.getColMap());
  std::vector<int> places;
  places.reserve(from.nnz());
  for (int i = 0; i < from.numRows(); ++i) {
    const int* const first = graph.entries.data() + graph.row_map(to_rows[i]);
    const int* const last = graph.entries.data() + graph.row_map(to_rows[i] + 1);
    const auto row = from.rowConst(i);
    for (int k = 0; k < row.length; ++k) {
      const int column = to_columns[row.colidx(k)];
      const int* const found = std::lower_bound(first, last, column);
      if (found == last || *found != column)
        throw std::logic_error("entry_offsets: an entry is not in the whole matrix");
      places.push_back(static_cast<int>(found - graph.entries.data()));
    }
  }
  return places;
}

std::vector<int> entry_offsets(const CrsMatrix& part, const CrsMatrix& whole) {
  return entry_offsets(part, numbers_of(*part.getRowMap()), numbers_of(*part.getColMap()), whole);
}

}  // namespace tunica::algebra
