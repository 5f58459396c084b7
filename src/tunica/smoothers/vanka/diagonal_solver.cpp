#include <cmath>

#include "tunica/base/trilinos.hpp"
#include "tunica/smoothers/dense/dense_inverse.hpp"
#include "tunica/smoothers/vanka/patch_solver.hpp"

namespace tunica::smoothers {

namespace {

/// The inverses of the node blocks, which all patches share, and of each patch
///   s_a = (B2 D⁻¹)_a,   t_a = (D⁻¹ B1ᵀ)_a,   1/S,   S = −c − Σ_a s_a (B1ᵀ)_a.
template <class Real>
class DiagonalSolver final : public PatchSolver {
public:
  DiagonalSolver(const CrsMatrix& K, const VankaPatches& patches, int velocities)
      : K_(&K), patches_(&patches), m_(velocities), inverses_(n_local_rows(K) / (m_ + 1) * m_ * m_),
        local_(2 * patches.rows.size()), row_of_column_(n_local(*K.getColMap()), -1),
        is_uncovered_(n_local_rows(K), 0), B1T_(n_local_rows(K)), B2_(n_local_rows(K)) {
    for (std::size_t i = 0; i < is_uncovered_.size(); ++i)
      row_of_column_[patches.column_of_row[i]] = static_cast<int>(i);
    for (const int row : patches.uncovered_rows) is_uncovered_[row] = 1;
  }

  int refresh() override {
    const int singular_node = invert_nodes();
    int singular = -1;
    for (int p = 0; p < patches_->n_patches(); ++p) {
      const bool is_regular = reduce(p);
      if (!is_regular && singular < 0) singular = p;
    }
    // The patch of a node's own pressure names the node.
    return singular_node >= 0 ? singular_node : singular;
  }

  void solve(int patch, const double* r, double* correction) const override {
    const int n = patches_->size(patch) - 1;
    const int* const rows = patches_->rows.data() + patches_->start[patch];
    const Real* const s = local_.data() + 2 * patches_->start[patch];
    const Real* const t = s + n;
    double rest = r[n];
    for (int a = 0; a < n; ++a) rest -= s[a] * r[a];
    const double p = correction[n] = t[n] * rest;  // (r_p − B2 D⁻¹ r_u) / S
    for (int first = 0, end; first < n; first = end) {
      const int node = rows[first] / (m_ + 1);
      const Real* const inverse = inverses_.data() + node * m_ * m_;
      for (end = first; end < n && rows[end] / (m_ + 1) == node;) ++end;
      for (int a = first; a < end; ++a) {  // u = D⁻¹ r_u − D⁻¹ B1ᵀ p
        const Real* const row = inverse + rows[a] % (m_ + 1) * m_;
        correction[a] = -t[a] * p;
        for (int b = first; b < end; ++b) correction[a] += row[rows[b] % (m_ + 1)] * r[b];
      }
    }
  }

  PrefetchRange memory(int patch) const override {
    return {local_.data() + 2 * patches_->start[patch],
            2 * sizeof(Real) * static_cast<std::size_t>(patches_->size(patch))};
  }

  double bytes() const override {
    return static_cast<double>(sizeof(Real) * (inverses_.size() + local_.size()) +
                               sizeof(int) * row_of_column_.size() + is_uncovered_.size() +
                               sizeof(double) * (B1T_.size() + B2_.size()));
  }

private:
  /// With zeros in the rows and columns of uncovered velocities. A node without inverse, or -1.
  int invert_nodes() {
    const auto K = K_->getLocalMatrixHost();
    int singular = -1;
    for (int node = 0; node < K.numRows() / (m_ + 1); ++node) {
      const int first = node * (m_ + 1);
      std::vector<double>& D = dense_;
      D.assign(m_ * m_, 0.0);
      for (int i = 0; i < m_; ++i) {
        const auto row = K.rowConst(first + i);
        for (int k = 0; k < row.length; ++k) {
          const int j = row_of_column_[row.colidx(k)] - first;
          if (j >= 0 && j < m_ && !is_uncovered_[first + i] && !is_uncovered_[first + j])
            D[i * m_ + j] = row.value(k);
        }
        if (is_uncovered_[first + i]) D[i * m_ + i] = 1.0;
      }
      if (!invert_dense(m_, D.data(), scratch_) && singular < 0) singular = node;
      for (int i = 0; i < m_; ++i)
        if (is_uncovered_[first + i]) D[i * m_ + i] = 0.0;
      std::copy(D.begin(), D.end(), inverses_.begin() + node * m_ * m_);
    }
    return singular;
  }

  /// s, t and 1/S of a patch; false where S is zero or not a number.
  bool reduce(int patch) {
    const int n = patches_->size(patch) - 1;
    const int* const rows = patches_->rows.data() + patches_->start[patch];
    Real* const s = local_.data() + 2 * patches_->start[patch];
    Real* const t = s + n;
    const double mc = read_coupling(rows, n);
    double S = mc;
    for (int a = 0; a < n; ++a) {
      const int first = rows[a] / (m_ + 1) * (m_ + 1), i = rows[a] - first;
      const Real* const inverse = inverses_.data() + rows[a] / (m_ + 1) * m_ * m_;
      double left = 0.0, right = 0.0;
      for (int j = 0; j < m_; ++j) {
        left += B2_[first + j] * inverse[j * m_ + i];
        right += inverse[i * m_ + j] * B1T_[first + j];
      }
      s[a] = static_cast<Real>(left);
      t[a] = static_cast<Real>(right);
      S -= left * B1T_[rows[a]];
    }
    t[n] = static_cast<Real>(1.0 / S);
    return S != 0.0 && std::isfinite(S);
  }

  /// The entries of a patch in B1ᵀ and B2 by rows. Returns that in −C.
  double read_coupling(const int* rows, int n) {
    const auto K = K_->getLocalMatrixHost();
    const int column = patches_->column_of_row[rows[n]];
    for (int a = 0; a < n; ++a) {
      B2_[rows[a]] = B1T_[rows[a]] = 0.0;
      const auto row = K.rowConst(rows[a]);
      for (int k = 0; k < row.length; ++k)
        if (row.colidx(k) == column) B1T_[rows[a]] = row.value(k);
    }
    double mc = 0.0;
    const auto row = K.rowConst(rows[n]);
    for (int k = 0; k < row.length; ++k) {
      const int j = row_of_column_[row.colidx(k)];
      if (j >= 0) B2_[j] = row.value(k);
      if (row.colidx(k) == column) mc = row.value(k);
    }
    return mc;
  }

  const CrsMatrix* K_;
  const VankaPatches* patches_;
  int m_;                       ///< velocities per node
  std::vector<Real> inverses_;  ///< m×m per node, row by row
  std::vector<Real> local_;     ///< s, t and 1/S, patch after patch, one number unused
  std::vector<int> row_of_column_;
  std::vector<char> is_uncovered_;
  std::vector<double> B1T_, B2_, dense_;  ///< of refresh(), as is the rest
  DenseScratch scratch_;
};

}  // namespace

template <class Real>
std::unique_ptr<PatchSolver> make_diagonal_solver(const CrsMatrix& K, const VankaPatches& patches,
                                                  int velocities) {
  return std::make_unique<DiagonalSolver<Real>>(K, patches, velocities);
}
template std::unique_ptr<PatchSolver> make_diagonal_solver<double>(const CrsMatrix&,
                                                                   const VankaPatches&, int);
template std::unique_ptr<PatchSolver> make_diagonal_solver<float>(const CrsMatrix&,
                                                                  const VankaPatches&, int);

}  // namespace tunica::smoothers
