#pragma once
#include <vector>

#include "tunica/base/types.hpp"

namespace tunica::algebra {

/// Takes the values of a vector on the rows of a square graph or matrix to its columns, own and
/// ghost. Collective.
void fetch_columns(const CrsGraph& graph, const MultiVector& rows, MultiVector& columns);
inline void fetch_columns(const CrsMatrix& matrix, const MultiVector& rows, MultiVector& columns) {
  fetch_columns(*matrix.getCrsGraph(), rows, columns);
}
/// Fetches the columns into a new vector.
Vector on_columns(const CrsGraph& graph, const Vector& rows);
inline Vector on_columns(const CrsMatrix& matrix, const Vector& rows) {
  return on_columns(*matrix.getCrsGraph(), rows);
}

/// A maximal independent set of a square graph, one flag per local column: no two
/// nodes of it are neighbours, every other node has a neighbour in it. Picked greedily in the
/// given order, a number per row, none twice: the set does not depend on where ranks meet.
/// Collective.
std::vector<char> independent_set(const CrsGraph& nodes, const Vector& order);

}  // namespace tunica::algebra
