#include "tunica/compare/residuals.hpp"

#include <algorithm>
#include <cmath>

#include "tunica/algebra/merged_matrix.hpp"
#include "tunica/base/trilinos.hpp"

namespace tunica::compare {

namespace {

/// Backward errors below this are those of rounding: a few hundred units of the last digit.
constexpr double rounding = 1e-13;

/// y_i += Σ_j |A_ij| |x_j|
void add_magnitudes(const CrsMatrix& A, const MultiVector& x, MultiVector& y) {
  const auto importer = A.getGraph()->getImporter();
  Vector ghosted(A.getColMap());
  if (importer.is_null())
    ghosted.update(1.0, x, 0.0);
  else
    ghosted.doImport(x, *importer, insert);
  const auto from = ghosted.getLocalViewHost(read_only);
  const auto to = y.getLocalViewHost(read_write);
  const auto local = A.getLocalMatrixHost();
  for (int i = 0; i < local.numRows(); ++i) {
    const auto row = local.rowConst(i);
    for (int k = 0; k < row.length; ++k)
      to(i, 0) += std::abs(row.value(k)) * std::abs(from(row.colidx(k), 0));
  }
}

/// |K||x| + |b| of the entries of K; what has none is small beside them.
algebra::BlockVector magnitudes(const algebra::BlockMatrix& K, const algebra::BlockVector& b,
                                const algebra::BlockVector& x) {
  algebra::BlockVector y = K.zero();
  if (!K.merged().is_null()) {
    const algebra::MergedMatrix merged(K);
    Vector all(merged.matrix()->getRowMap()), sums(merged.matrix()->getRowMap());
    merged.merge(x, all);
    add_magnitudes(*merged.matrix(), all, sums);
    merged.split(sums, y);
  } else {
    for (int i = 0; i < K.n_blocks(); ++i)
      for (int j = 0; j < K.n_blocks(); ++j)
        if (!K(i, j).is_null()) add_magnitudes(*K(i, j), x[j], y[i]);
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
  return largest_of_fields() <= enough && (relative <= enough || backward_error <= rounding);
}

bool Residuals::are_rounding(double tolerance) const {
  return are_within(tolerance) && relative > 2.0 * tolerance + 1e-14;
}

Residuals residuals_of(const algebra::BlockMatrix& K, const algebra::BlockVector& b,
                       const algebra::BlockVector& x) {
  algebra::BlockVector r = K.zero();
  residual(K, b, x, r);
  const algebra::BlockVector sums = magnitudes(K, b, x);
  Residuals result;
  for (int i = 0; i < K.n_blocks(); ++i)
    result.of_fields.push_back(ratio(r[i].norm2(), sums[i].norm2()));
  result.backward_error = ratio(norm(r), norm(sums));
  const double size = norm(b);
  result.relative = size == 0.0 ? 0.0 : norm(r) / size;
  return result;
}

void residual(const algebra::BlockMatrix& K, const algebra::BlockVector& b,
              const algebra::BlockVector& x, algebra::BlockVector& r) {
  K.apply(x, r);
  for (int i = 0; i < K.n_blocks(); ++i) r[i].update(1.0, b[i], -1.0);
}

double norm(const algebra::BlockVector& x) {
  double sum = 0.0;
  for (int i = 0; i < x.n_blocks(); ++i) sum += x[i].norm2() * x[i].norm2();
  return std::sqrt(sum);
}

}  // namespace tunica::compare
