#pragma once
#include <optional>
#include <string>
#include <vector>

#include "tunica/algebra/block_matrix.hpp"
#include "tunica/algebra/picked_matrix.hpp"

namespace tunica::algebra {

/// Some unknowns of a block system as a system of its own: those at the nodes of some parts of the
/// space. With R, which picks them,
///
///   K_s = R K Rᵀ        x_s = R x        x ← x + ω Rᵀ x_s
///
/// The numbers of unknowns and nodes stay. Low-rank and matrix-free parts of K are omitted.
class SubSystem {
public:
  /// parts: names of K's space. K must outlive the object. Collective.
  SubSystem(const BlockMatrix& K, const std::vector<std::string>& parts);

  /// K_s; refresh() takes over the present values.
  const BlockMatrix& matrix() const { return K_; }
  void refresh();
  /// Takes those of one block from a matrix with the entries of that block of K.
  void refresh_block(int row, int column, const CrsMatrix& values);
  /// R A Rᵀ of a matrix between the unknowns of two blocks. Collective.
  Teuchos::RCP<CrsMatrix> pick(const CrsMatrix& A) const;

  void restrict(const BlockVector& x, BlockVector& part) const;
  void add(double factor, const BlockVector& part, BlockVector& x) const;

private:
  int block_with(const Map& map) const;

  const BlockMatrix* whole_;
  BlockMatrix K_;
  std::vector<Vector> unknowns_;                     ///< flags per block of the whole
  std::vector<std::vector<int>> rows_;               ///< local rows in the whole, per block
  std::vector<std::optional<PickedMatrix>> picked_;  ///< row by row; none where K lacks the block
};

}  // namespace tunica::algebra
