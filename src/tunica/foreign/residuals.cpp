#include "tunica/foreign/residuals.hpp"

#include <algorithm>
#include <cmath>

#include "tunica/algebra/merged_matrix.hpp"
#include "tunica/base/trilinos.hpp"
#include "tunica/systems/entry_sums.hpp"
#include "tunica/systems/right_side.hpp"

namespace tunica::foreign {

namespace {

/// Backward errors below this are those of rounding: a few hundred units of the last digit.
constexpr double rounding = 1e-13;

/// Relative residual beyond which x is so large, as that of a singular matrix, that a small
/// backward error says nothing.
constexpr double far_off = 1e-2;

/// |K||x| + |b| of the entries of K; what has none is small beside them.
algebra::BlockVector magnitudes(const algebra::BlockMatrix& K, const algebra::BlockVector& b,
                                const algebra::BlockVector& x) {
  algebra::BlockVector y = K.zero();
  if (!K.merged().is_null()) {
    const algebra::MergedMatrix merged(K);
    Vector all(merged.matrix()->getRowMap()), sums(merged.matrix()->getRowMap());
    merged.merge(x, all);
    systems::add_magnitudes(*merged.matrix(), all, sums);
    merged.split(sums, y);
  } else {
    for (int i = 0; i < K.n_blocks(); ++i)
      for (int j = 0; j < K.n_blocks(); ++j)
        if (!K(i, j).is_null()) systems::add_magnitudes(*K(i, j), x[j], y[i]);
  }
  for (int i = 0; i < K.n_blocks(); ++i) {
    Vector size(b[i].getMap());
    size.abs(b[i]);
    y[i].update(1.0, size, 1.0);
  }
  return y;
}

double ratio(double part, double whole) { return part == 0.0 ? 0.0 : part / whole; }

}  // namespace

// std::max passes over what is no number.
double Residuals::largest_of_fields() const {
  double largest = 0.0;
  for (const double one : of_fields) largest = one <= largest ? largest : one;
  return largest;
}

bool Residuals::are_within(double tolerance) const {
  // The recurrence of a Krylov method may drift from the truth by round-off, not by more.
  const double enough = 2.0 * tolerance + 1e-14;
  // A field alone cannot hide behind one that adds up more.
  return largest_of_fields() <= enough &&
         (relative <= enough || (largest_of_fields() <= rounding && relative <= far_off));
}

bool Residuals::are_rounding(double tolerance) const {
  return are_within(tolerance) && relative > 2.0 * tolerance + 1e-14;
}

namespace {

/// sums: |K||x| + |b|
Residuals compared(const algebra::BlockVector& r, const algebra::BlockVector& sums,
                   const algebra::BlockVector& b) {
  Residuals result;
  for (int i = 0; i < r.n_blocks(); ++i)
    result.of_fields.push_back(ratio(r[i].norm2(), sums[i].norm2()));
  result.backward_error = ratio(norm(r), norm(sums));
  const double size = norm(b);
  result.relative = size == 0.0 ? 0.0 : norm(r) / size;
  return result;
}

/// x of the rows as they are given: R⁻¹ x.
algebra::BlockVector in_given_rows(const systems::System& system, const algebra::BlockVector& x) {
  algebra::BlockVector given = system.K.zero();
  for (int i = 0; i < x.n_blocks(); ++i) {
    const auto from = x[i].getLocalViewHost(read_only);
    const auto scale = system.row_scale[i].getLocalViewHost(read_only);
    const auto to = given[i].getLocalViewHost(overwrite_all);
    for (std::size_t k = 0; k < to.extent(0); ++k)
      to(k, 0) = scale(k, 0) == 0.0 ? 0.0 : from(k, 0) / scale(k, 0);
  }
  return given;
}

}  // namespace

Residuals residuals_of(const algebra::BlockMatrix& K, const algebra::BlockVector& b,
                       const algebra::BlockVector& x) {
  algebra::BlockVector r = K.zero();
  return judge_of(K, b)(x, r);
}

Judge judge_of(const algebra::BlockMatrix& K, const algebra::BlockVector& b) {
  return [&](const algebra::BlockVector& x, algebra::BlockVector& r) {
    // r = b − K x
    K.apply(x, r);
    for (int i = 0; i < K.n_blocks(); ++i) r[i].update(1.0, b[i], -1.0);
    return compared(r, magnitudes(K, b, x), b);
  };
}

Judge judge_of(const systems::System& system) {
  return [&](const algebra::BlockVector& y, algebra::BlockVector& r) {
    algebra::BlockVector x = systems::of_free(system, y);
    // r = R (b' − K C y)
    system.given.apply(x, r);
    systems::take_to_rows(system, r);
    for (int i = 0; i < y.n_blocks(); ++i) r[i].update(1.0, system.b[i], -1.0);
    // R (|K||x| + |b|)
    for (int i = 0; i < y.n_blocks(); ++i) x[i].update(1.0, system.known[i], 1.0);
    algebra::BlockVector sums = magnitudes(system.given, system.given_b, x);
    systems::take_to_rows(system, sums);
    Residuals result = compared(r, sums, system.b);
    // R may have shrunk rows that outweigh the others in |r| as it is given.
    const Residuals given = compared(in_given_rows(system, r), in_given_rows(system, sums),
                                     in_given_rows(system, system.b));
    if (given.largest_of_fields() > rounding)
      result.relative = std::max(result.relative, given.relative);
    return result;
  };
}

}  // namespace tunica::foreign
