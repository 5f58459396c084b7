#pragma once
#include "tunica/base/types.hpp"

namespace tunica::algebra {

/// Numbers of the unknowns of a mixed matrix: (components + 1)*node + i, the scalar (the pressure)
/// last. In its block a vector unknown has the number components*node + i, a scalar one node.
/// Not every number need be there: a node may lack unknowns.
struct DofLayout {
  int components = 3;

  int dofs() const { return components + 1; }
  bool is_scalar(GlobalOrdinal number) const { return number % dofs() == components; }
  GlobalOrdinal in_block(GlobalOrdinal number) const {
    const GlobalOrdinal node = number / dofs();
    return is_scalar(number) ? node : components * node + number % dofs();
  }
  GlobalOrdinal of_vector(GlobalOrdinal in_block) const {
    return in_block / components * dofs() + in_block % components;
  }
  GlobalOrdinal of_scalar(GlobalOrdinal node) const { return node * dofs() + components; }

  /// The unknowns of both blocks, ascending on each rank. Collective.
  Teuchos::RCP<const Map> mixed_map(const Map& vectors, const Map& scalars) const;
  /// The unknowns of one block in those of both. Collective.
  Teuchos::RCP<const Map> vector_map(const Map& mixed) const { return block_map(mixed, false); }
  Teuchos::RCP<const Map> scalar_map(const Map& mixed) const { return block_map(mixed, true); }

private:
  Teuchos::RCP<const Map> block_map(const Map& mixed, bool of_scalars) const;
};

}  // namespace tunica::algebra
