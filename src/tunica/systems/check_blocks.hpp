#pragma once
#include <string>
#include <vector>

#include "tunica/systems/matrix_files.hpp"

namespace tunica::systems {

/// Contents of the files of a block system K x = b, K = [A B1T; B2 −C]: the rank's portion of the
/// rows of each block, the square ones with their diagonals.
struct Blocks {
  MatrixRows A, B1T, B2, mC;
  ColumnRows b;
};

/// Rows of b to the portions of a block whose rows begin there. Collective.
std::vector<double> rows_of_block(const ColumnRows& b, long long begin, long long count,
                                  const Comm& comm);

/// Makes a row of K without entries an equation x = 0 where its right-hand side is zero, too.
/// Returns a note on such rows by their numbers in the files, from 1; empty where there are none.
/// Throws Error where the right-hand side is not zero: nothing solves that. Collective.
std::string fill_empty_rows(Blocks& blocks);

/// A note where C has the sign that it has within K; empty where it has not. Collective.
std::string doubt_sign_of_C(const Blocks& blocks);

}  // namespace tunica::systems
