#pragma once
#include "tunica/base/types.hpp"

namespace tunica::systems {

/// y ← y + |A| |x|, entry by entry. Collective.
void add_magnitudes(const CrsMatrix& A, const MultiVector& x, MultiVector& y);
/// y ← y + |A|ᵀ |x|. Collective.
void add_column_magnitudes(const CrsMatrix& A, const MultiVector& x, MultiVector& y);

}  // namespace tunica::systems
