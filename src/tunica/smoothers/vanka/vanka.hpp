#pragma once
#include <memory>
#include <string>

#include "tunica/smoothers/vanka/vanka_patches.hpp"

namespace tunica::smoothers {

struct VankaOptions {
  int sweeps = 1;
  double damping = 1.0;             ///< ω: a patch is corrected by ω times its solution
  std::string order = "symmetric";  ///< of the patches: "forward", "backward", "symmetric"
  bool is_additive = false;         ///< all patches at once, each row's corrections averaged
  bool is_single = false;           ///< keep the inverses in single precision
  std::string patch = "full";       ///< "full", "diagonal", "node pair": see vanka_patches.hpp
};

/// Vanka's smoother [Va86]: x += ω Σ Pᵀ (P K Pᵀ)⁻¹ P (b − K x), patch after patch, each with the
/// newest x of its rank. Values of other ranks are those at the beginning of the sweep.
class Vanka {
public:
  virtual ~Vanka() = default;
  /// Takes over the present values of K and inverts the patches. Finds the patches anew only
  /// where entries of B2 have become zero or ceased to be: the result is always that of a new
  /// smoother. Throws std::runtime_error on all ranks where one has a singular patch. Collective.
  virtual void refresh() = 0;
  /// x ← x after the sweeps, column by column. Throws std::invalid_argument for unlike numbers of
  /// columns. Collective.
  virtual void smooth(const MultiVector& b, MultiVector& x) const = 0;
  /// Bytes of patches, inverses and copies of the matrix on this rank.
  virtual double bytes() const = 0;
};

/// mixed: of the rows of K, which must outlive the smoother and keep its graph. Throws
/// std::invalid_argument on all ranks where patches of nodes are asked for and rows of one have no
/// place. Collective.
std::unique_ptr<Vanka> make_vanka(const CrsMatrix& K, const MixedRows& mixed,
                                  const VankaOptions& options);

}  // namespace tunica::smoothers
