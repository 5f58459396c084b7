#pragma once
#include <functional>
#include <vector>

#include "tunica/algebra/block_matrix.hpp"
#include "tunica/systems/read_system.hpp"

namespace tunica::foreign {

/// How far x is from a solution of K x = b. A norm over all unknowns hides a field whose rows are
/// small beside those of another; each field is therefore judged by what its own rows add up.
///
///   r = b − K x                     residual, r_f its part in the rows of field f
///   η_f = |r_f| / ||K||x| + |b||_f  of a field: 0 where the denominator is
///   η   = |r| / ||K||x| + |b||      backward error: x solves a system whose entries differ by η
///   ρ   = |r| / |b|                 relative residual; cannot fall below ε ||K||x|| / |b|
struct Residuals {
  std::vector<double> of_fields;  ///< η_f, in the order of the blocks
  double backward_error = 0.0;    ///< η
  double relative = 0.0;          ///< ρ, 0 for b = 0

  double largest_of_fields() const;
  /// Solved to the tolerance: each field is, and so is the whole by its relative residual, or as
  /// nearly as double precision allows.
  bool are_within(double tolerance) const;
  /// The relative residual is as small as rounding permits, though not within the tolerance.
  bool are_rounding(double tolerance) const;
};

/// Collective.
Residuals residuals_of(const algebra::BlockMatrix& K, const algebra::BlockVector& b,
                       const algebra::BlockVector& x);

/// Judges x, and leaves the residual b − K x of what is judged. Collective.
using Judge = std::function<Residuals(const algebra::BlockVector& x, algebra::BlockVector& r)>;

/// Of K x = b as it is solved; both must outlive it.
Judge judge_of(const algebra::BlockMatrix& K, const algebra::BlockVector& b);
/// Of the system as another program gives it, in the rows of unknowns that are not known, each
/// divided as Preparation says: with entries that were left out as rounding, and without what makes
/// K regular. The relative residual is the larger one of these rows and of the same as they are
/// given. The system must outlive it.
Judge judge_of(const systems::System& system);

}  // namespace tunica::foreign
