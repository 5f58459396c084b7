#pragma once
#include "tunica/smoothers/vanka/patch_rows.hpp"

namespace tunica::smoothers {

/// Rows of a matrix with the unknowns 4*node + i, the pressure last, copied as blocks of a node's
/// rows and a node's columns: one column number for all entries of a block, and sums of four
/// products that the processor works on side by side. Entries that K lacks are zeros.
///
/// The pressure row is apart: a patch has the velocity rows of many nodes, the pressure row of
/// one.
class NodeRows final : public PatchRows {
public:
  static bool can_hold(const CrsMatrix& K, const std::vector<char>& is_pressure);

  explicit NodeRows(const CrsMatrix& K);
  void refresh() override;
  void residual(const int* rows, int n, const double* b, const double* x, double* r,
                const PrefetchRange& ahead) const override;
  double bytes() const override;

private:
  void find_blocks();

  const CrsMatrix* K_;
  std::vector<std::size_t> start_;  ///< of each node's blocks
  std::vector<int> columns_;        ///< of each block: the first of its four
  std::vector<double> velocity_;    ///< 3×4 of each block, row by row
  std::vector<double> pressure_;    ///< 1×4 of each block
  std::vector<int> block_of_node_;  ///< scratch of refresh(): by the columns' nodes
};

}  // namespace tunica::smoothers
