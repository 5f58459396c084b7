#pragma once
#include "tunica/base/types.hpp"

namespace tunica::linear {

/// |b − Kx| / |b|, zero where b is. Collective.
inline double relative_residual(const Operator& K, const MultiVector& b, const MultiVector& x) {
  MultiVector r(b.getMap(), 1);
  K.apply(x, r);
  r.update(1.0, b, -1.0);
  double size = 0.0, rest = 0.0;
  b.norm2(Teuchos::ArrayView<double>(&size, 1));
  r.norm2(Teuchos::ArrayView<double>(&rest, 1));
  return size == 0.0 ? 0.0 : rest / size;
}

}  // namespace tunica::linear
