#pragma once
#include <memory>
#include <vector>

#include "tunica/base/types.hpp"
#include "tunica/smoothers/vanka/prefetch.hpp"

namespace tunica::smoothers {

/// The rows of a rank's matrix as a sweep over patches reads them, each dozens of times.
class PatchRows {
public:
  virtual ~PatchRows() = default;
  /// Takes over the present values of the matrix.
  virtual void refresh() = 0;
  /// r = b − K x in the n rows; x has own and ghost values. Asks for the memory ahead meanwhile.
  virtual void residual(const int* rows, int n, const double* b, const double* x, double* r,
                        const PrefetchRange& ahead) const = 0;
  /// Bytes beside those of the matrix.
  virtual double bytes() const = 0;
};

/// Copies of the node blocks where the unknowns are 4*node + i, the pressure last, in rows and
/// columns; else the rows of K. K must outlive them.
std::unique_ptr<PatchRows> make_patch_rows(const CrsMatrix& K,
                                           const std::vector<char>& is_pressure);

}  // namespace tunica::smoothers
