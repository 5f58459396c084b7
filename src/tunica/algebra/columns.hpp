#pragma once
#include <stdexcept>
#include <string>

#include "tunica/base/types.hpp"

namespace tunica::algebra {

/// Throws std::invalid_argument where b and x have different numbers of columns.
inline void check_columns(const std::string& who, const MultiVector& b, const MultiVector& x) {
  if (b.getNumVectors() != x.getNumVectors())
    throw std::invalid_argument(who + ": " + std::to_string(b.getNumVectors()) +
                                " right-hand side(s), but " + std::to_string(x.getNumVectors()) +
                                " solution(s).");
}

/// work(b, x) for one column after the other, of a right-hand side and its solution. Throws as
/// check_columns().
template <class Work>
void for_each_column(const std::string& who, const MultiVector& b, MultiVector& x,
                     const Work& work) {
  check_columns(who, b, x);
  if (b.getNumVectors() == 1) return work(b, x);
  for (std::size_t c = 0; c < b.getNumVectors(); ++c)
    work(*b.getVector(c), *x.getVectorNonConst(c));
}

}  // namespace tunica::algebra
