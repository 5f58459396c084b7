#pragma once
#include <array>
#include <string>
#include <vector>

#include "tunica/systems/matrix_files.hpp"

namespace tunica::systems {

/// A number for each vector and each scalar unknown of the rank's portion.
using OfUnknowns = std::array<std::vector<double>, 2>;

/// Contents of the files of a block system K x = b, K = [A B1T; B2 −C]: the rank's portion of the
/// rows of each block, the square ones with their diagonals. Without scalar unknowns all blocks but
/// A are empty.
struct Blocks {
  MatrixRows A, B1T, B2, mC;
  OfUnknowns b;
  /// How messages name the vector and the scalar rows: the files, and in them, from 0, the number
  /// of each row of the portion.
  std::array<std::string, 2> files{"A and B1T", "B2 and C"};
  std::array<std::vector<long long>, 2> file_rows;

  /// K(i, j); 0: vector, 1: scalar unknowns.
  MatrixRows& operator()(int i, int j) { return i == 0 ? (j == 0 ? A : B1T) : (j == 0 ? B2 : mC); }
  const MatrixRows& operator()(int i, int j) const {
    return i == 0 ? (j == 0 ? A : B1T) : (j == 0 ? B2 : mC);
  }
  const Comm& comm() const { return *A.comm; }
  std::size_t n_local(int i) const { return (*this)(i, i).n_local_rows(); }
  long long n_rows(int i) const { return (*this)(i, i).n_rows; }
};

/// "rows 6 and 21 of B2 and C", "row 3 of A and B1T", "rows 1, 2, 3, 4, 5, 6 and 12 more of K" of
/// local rows of a field of the blocks, on rank 0; empty for none of any rank. Collective.
std::string text_of_rows(const Blocks& blocks, int field, const std::vector<std::size_t>& rows);

}  // namespace tunica::systems
