#pragma once
#include <array>
#include <string>
#include <vector>

#include "tunica/systems/matrix_files.hpp"

namespace tunica::systems {

/// A number for each vector and each scalar unknown of the rank's portion.
using OfUnknowns = std::array<std::vector<double>, 2>;

/// The blocks of K = [A B1T; B2 −C] of another program: the rank's portion of the rows of each
/// block, the square ones with their diagonals. Without scalar unknowns all blocks but A are empty.
struct Blocks {
  MatrixRows A, B1T, B2, mC;
  /// Factors of the rows that make a saddle-point system of what is given.
  std::array<double, 2> signs{1.0, 1.0};
  /// How messages name the vector and the scalar rows: the files, and in them, from 0, the number
  /// of each row of the portion.
  std::array<std::string, 2> files{"A and B1T", "B2 and C"};
  std::array<std::vector<long long>, 2> file_rows;
  int in_nodes = 0;  ///< ScalarRows::in_nodes of one matrix; 0 of several
  /// The first rows of the right-hand side that belong to the fields: file_rows count from there.
  std::array<long long, 2> first_row{};

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
/// rows that each rank counts from 0, on rank 0; empty for none of any rank. Collective.
std::string text_of_rows(const Comm& comm, const std::vector<long long>& rows,
                         const std::string& files);
/// Of local rows of a field of the blocks.
std::string text_of_rows(const Blocks& blocks, int field, const std::vector<std::size_t>& rows);

}  // namespace tunica::systems
