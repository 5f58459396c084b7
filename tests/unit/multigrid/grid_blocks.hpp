#pragma once
#include "tunica/algebra/block_matrices.hpp"
#include "tunica/base/trilinos.hpp"
#include "unit/multigrid/grid.hpp"

namespace tunica::test {

/// The numbers of its rows.
inline Teuchos::RCP<const Vector> order_of(const CrsMatrix& A) {
  const auto order = Teuchos::rcp(new Vector(A.getRowMap()));
  for (const GlobalOrdinal row : global_numbers(*A.getRowMap()))
    order->replaceGlobalValue(row, static_cast<Scalar>(row));
  return order;
}

/// The diagonal blocks, Laplacians, of a system on a grid.
inline algebra::BlockMatrices blocks_on(const Grid& grid, const CommPtr& comm = world(),
                                        int components = 3) {
  algebra::BlockMatrices K;
  K.A = grid.laplacian(comm, components);
  K.mC = grid.laplacian(comm);
  K.components = components;
  K.vectors = K.scalars = {K.mC, order_of(*K.mC)};
  return K;
}

}  // namespace tunica::test
