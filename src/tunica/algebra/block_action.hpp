#pragma once
#include "tunica/algebra/block_vector.hpp"

namespace tunica::algebra {

/// A linear map of which only the products with vectors are known.
class BlockAction {
public:
  virtual ~BlockAction() = default;
  /// L is zero at present.
  virtual bool is_zero() const { return false; }
  /// y ← y + L x. Collective.
  virtual void add(const BlockVector& x, BlockVector& y) const = 0;
};

}  // namespace tunica::algebra
