#pragma once
#include <vector>

namespace tunica::linear {

/// Entries of a matrix by their rows and columns, from 1; in any order.
struct Entries {
  std::vector<int> rows, columns;
};

/// Place of each of n unknowns in an order of elimination, from 0, by METIS' nested dissection of
/// the graph of A + Aᵀ. Unknowns with equal neighbours, as those of a node, are ordered as one.
std::vector<int> nested_dissection(int n, const Entries& entries);

}  // namespace tunica::linear
