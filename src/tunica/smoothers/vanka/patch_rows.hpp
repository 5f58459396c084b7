#pragma once
#include <cstddef>
#include <memory>
#include <vector>

#include "tunica/base/types.hpp"

namespace tunica::smoothers {

/// A range of memory that will be needed soon.
struct PrefetchRange {
  const void* from = nullptr;
  std::size_t bytes = 0;
};

/// Asks for the parts first .. last-1 of n of it without waiting: only as far as the second cache,
/// where a first of 32 kB would have to give way to it.
inline void prefetch(const PrefetchRange& ahead, int first, int last, int n) {
  const char* const from = static_cast<const char*>(ahead.from);
  const std::size_t end = ahead.bytes * last / n;
  for (std::size_t i = ahead.bytes * first / n; i < end; i += 64)
    __builtin_prefetch(from + i, 0, 2);
}

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
