#pragma once
#include <memory>
#include <string>
#include <vector>

#include "tunica/smoothers/vanka/patch_rows.hpp"
#include "tunica/smoothers/vanka/vanka_patches.hpp"

namespace tunica::smoothers {

/// Solves each patch of a sweep for itself.
class PatchSolver {
public:
  virtual ~PatchSolver() = default;
  /// Takes over the present values of the matrix. The number of a patch without inverse, or -1.
  virtual int refresh() = 0;
  /// correction = solution of a patch for the residual r of its rows.
  virtual void solve(int patch, const double* r, double* correction) const = 0;
  /// Memory that solve() will read.
  virtual PrefetchRange memory(int patch) const = 0;
  virtual double bytes() const = 0;
};

/// By the dense inverse of each patch, kept as double or float. All must outlive it.
template <class Real>
std::unique_ptr<PatchSolver> make_dense_solver(const CrsMatrix& K, const VankaPatches& patches);

/// By the inverses of the velocity's node blocks and the Schur complement of the one pressure:
///
///   [D B1ᵀ; B2 −c] [u; p] = [r_u; r_p],  D the node blocks of A
///
/// patches: make_nodal_patches() of the same. All must outlive it.
template <class Real>
std::unique_ptr<PatchSolver> make_diagonal_solver(const CrsMatrix& K, const VankaPatches& patches,
                                                  const MixedRows& mixed);

}  // namespace tunica::smoothers
