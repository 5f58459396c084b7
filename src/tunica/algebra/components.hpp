#pragma once
#include "tunica/base/types.hpp"

namespace tunica::algebra {

/// Rows 3 k + i of a vector of three unknowns per node as row k of three columns.
inline void to_columns(const MultiVector& x, MultiVector& columns) {
  const auto from = x.getLocalViewHost(read_only);
  const auto to = columns.getLocalViewHost(overwrite_all);
  for (std::size_t k = 0; k < to.extent(0); ++k)
    for (int i = 0; i < 3; ++i) to(k, i) = from(3 * k + i, 0);
}

/// And back.
inline void from_columns(const MultiVector& columns, MultiVector& x) {
  const auto from = columns.getLocalViewHost(read_only);
  const auto to = x.getLocalViewHost(overwrite_all);
  for (std::size_t k = 0; k < from.extent(0); ++k)
    for (int i = 0; i < 3; ++i) to(3 * k + i, 0) = from(k, i);
}

}  // namespace tunica::algebra
