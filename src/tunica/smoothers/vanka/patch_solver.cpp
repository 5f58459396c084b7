#include "tunica/smoothers/vanka/patch_solver.hpp"

#include <cmath>

#include "tunica/base/trilinos.hpp"
#include "tunica/smoothers/dense/dense.hpp"

namespace tunica::smoothers {

namespace {

template <class Real>
class DenseSolver final : public PatchSolver {
public:
  DenseSolver(const CrsMatrix& K, const VankaPatches& patches)
      : K_(&K), patches_(&patches), slot_of_column_(n_local(*K.getColMap()), -1) {
    place_.push_back(0);
    for (int p = 0; p < patches.n_patches(); ++p) {
      const std::size_t n = patches.size(p);
      place_.push_back(place_.back() + n * n);
    }
    inverses_.resize(place_.back());
    const std::size_t most = patches.largest();
    dense_.resize(most * most);
  }

  int refresh() override {
    // A_P⁻¹ of each patch, inverted in double precision and kept in that asked for
    int singular = -1;
    const auto K = K_->getLocalMatrixHost();
    for (int p = 0; p < patches_->n_patches(); ++p) {
      extract(K, p);
      const int n = patches_->size(p);
      if (!invert_dense(n, dense_.data(), scratch_) && singular < 0) singular = p;
      std::copy_n(dense_.begin(), n * n, inverses_.begin() + place_[p]);
    }
    return singular;
  }

  void solve(int patch, const double* r, double* correction) const override {
    dense_product(patches_->size(patch), inverses_.data() + place_[patch], r, correction);
  }

  PrefetchRange memory(int patch) const override {
    return {inverses_.data() + place_[patch], sizeof(Real) * (place_[patch + 1] - place_[patch])};
  }

  double bytes() const override {
    return static_cast<double>(sizeof(Real) * inverses_.size() +
                               sizeof(std::size_t) * place_.size());
  }

private:
  /// The patch column by column, which makes its inverse one column by column.
  template <class Local>
  void extract(const Local& K, int patch) {
    const int n = patches_->size(patch);
    const int* const rows = patches_->rows.data() + patches_->start[patch];
    for (int a = 0; a < n; ++a) slot_of_column_[patches_->column_of_row[rows[a]]] = a;
    std::fill_n(dense_.begin(), n * n, 0.0);
    for (int a = 0; a < n; ++a) {
      const auto row = K.rowConst(rows[a]);
      for (int k = 0; k < row.length; ++k) {
        const int slot = slot_of_column_[row.colidx(k)];
        if (slot >= 0) dense_[slot * n + a] = row.value(k);
      }
    }
    for (int a = 0; a < n; ++a) slot_of_column_[patches_->column_of_row[rows[a]]] = -1;
  }

  const CrsMatrix* K_;
  const VankaPatches* patches_;
  std::vector<std::size_t> place_;   ///< of each patch's inverse
  std::vector<Real> inverses_;       ///< dense, column by column
  std::vector<int> slot_of_column_;  ///< of refresh(), as are the rest
  std::vector<double> dense_;
  DenseScratch scratch_;
};

/// The inverses of the node blocks, which all patches share, and of each patch
///   s_a = (B2 D⁻¹)_a,   t_a = (D⁻¹ B1ᵀ)_a,   1/S,   S = −c − Σ_a s_a (B1ᵀ)_a.
template <class Real>
class DiagonalSolver final : public PatchSolver {
public:
  DiagonalSolver(const CrsMatrix& K, const VankaPatches& patches, const MixedRows& mixed)
      : K_(&K), patches_(&patches), mixed_(&mixed), places_(rows_of_places(mixed)),
        slot_(n_local_rows(K), -1), local_(2 * patches.rows.size()),
        row_of_column_(n_local(*K.getColMap()), -1), is_uncovered_(n_local_rows(K), 0),
        B1T_(n_local_rows(K)), B2_(n_local_rows(K)) {
    for (std::size_t i = 0; i < is_uncovered_.size(); ++i)
      row_of_column_[patches.column_of_row[i]] = static_cast<int>(i);
    for (const int row : patches.uncovered_rows) is_uncovered_[row] = 1;
    inverse_at_.push_back(0);
    for (int place = 0; place < places_.n_places(); ++place) {
      const int m = places_.n_velocities[place];
      for (int i = 0; i < m; ++i) slot_[velocities_of(place)[i]] = i;
      inverse_at_.push_back(inverse_at_.back() + m * m);
    }
    inverses_.resize(inverse_at_.back());
  }

  int refresh() override {
    // D⁻¹ of all places first: each patch that reaches one shares it.
    const int singular_pressure = invert_places();
    int singular = -1;
    for (int p = 0; p < patches_->n_patches(); ++p) {
      const bool is_regular = reduce(p);
      if (!is_regular && singular < 0) singular = p;
    }
    return singular_pressure >= 0 ? singular_pressure : singular;
  }

  void solve(int patch, const double* r, double* correction) const override {
    // [D B1ᵀ; B2 −c] (u, p) = (r_u, r_p) by its Schur complement S:
    //
    //   p = (r_p − s·r_u)/S,   u = D⁻¹ r_u − t p,   s = B2 D⁻¹,   t = D⁻¹ B1ᵀ
    const int n = patches_->size(patch) - 1;
    const int* const rows = patches_->rows.data() + patches_->start[patch];
    const Real* const s = local_.data() + 2 * patches_->start[patch];
    const Real* const t = s + n;
    double rest = r[n];
    for (int a = 0; a < n; ++a) rest -= s[a] * r[a];
    const double p = correction[n] = t[n] * rest;  // (r_p − B2 D⁻¹ r_u) / S
    // Velocities of a vertex stand together in a patch, and D⁻¹ acts among them alone.
    for (int first = 0, end; first < n; first = end) {
      const int place = mixed_->place[rows[first]], m = places_.n_velocities[place];
      const Real* const inverse = inverses_.data() + inverse_at_[place];
      for (end = first; end < n && mixed_->place[rows[end]] == place;) ++end;
      for (int a = first; a < end; ++a) {  // u = D⁻¹ r_u − D⁻¹ B1ᵀ p
        const Real* const row = inverse + slot_[rows[a]] * m;
        correction[a] = -t[a] * p;
        for (int b = first; b < end; ++b) correction[a] += row[slot_[rows[b]]] * r[b];
      }
    }
  }

  PrefetchRange memory(int patch) const override {
    return {local_.data() + 2 * patches_->start[patch],
            2 * sizeof(Real) * static_cast<std::size_t>(patches_->size(patch))};
  }

  double bytes() const override {
    return static_cast<double>(sizeof(Real) * (inverses_.size() + local_.size()) +
                               sizeof(std::size_t) * (inverse_at_.size() + places_.start.size()) +
                               sizeof(int) * (row_of_column_.size() + slot_.size() +
                                              places_.rows.size() + places_.n_velocities.size()) +
                               is_uncovered_.size() + sizeof(double) * (B1T_.size() + B2_.size()));
  }

private:
  const int* velocities_of(int place) const { return places_.rows.data() + places_.start[place]; }

  /// With zeros in the rows and columns of uncovered velocities. The patch of a pressure where
  /// there is no inverse, or -1.
  int invert_places() {
    const auto K = K_->getLocalMatrixHost();
    int singular = -1;
    for (int place = 0; place < places_.n_places(); ++place) {
      const int m = places_.n_velocities[place];
      const int* const rows = velocities_of(place);
      std::vector<double>& D = dense_;
      D.assign(m * m, 0.0);
      for (int i = 0; i < m; ++i) {
        const auto row = K.rowConst(rows[i]);
        for (int k = 0; k < row.length; ++k) {
          const int j = row_of_column_[row.colidx(k)];
          if (j >= 0 && mixed_->place[j] == place && slot_[j] >= 0 && !is_uncovered_[rows[i]] &&
              !is_uncovered_[j])
            D[i * m + slot_[j]] = row.value(k);
        }
        // A one keeps the block regular; it is taken out again behind the inversion.
        if (is_uncovered_[rows[i]]) D[i * m + i] = 1.0;
      }
      if (m > 0 && !invert_dense(m, D.data(), scratch_) && singular < 0)
        singular = patch_that_reaches(place);
      for (int i = 0; i < m; ++i)
        if (is_uncovered_[rows[i]]) D[i * m + i] = 0.0;
      std::copy(D.begin(), D.end(), inverses_.begin() + inverse_at_[place]);
    }
    return singular;
  }

  int patch_that_reaches(int place) const {
    for (int p = 0; p < patches_->n_patches(); ++p)
      for (std::size_t k = patches_->start[p]; k < patches_->start[p + 1]; ++k)
        if (mixed_->place[patches_->rows[k]] == place) return p;
    return 0;
  }

  /// s, t and 1/S of a patch; false where S is zero or not a number.
  bool reduce(int patch) {
    const int n = patches_->size(patch) - 1;
    const int* const rows = patches_->rows.data() + patches_->start[patch];
    Real* const s = local_.data() + 2 * patches_->start[patch];
    Real* const t = s + n;
    const double mc = read_coupling(rows, n);
    // s_a = Σ_j B2_j (D⁻¹)_ja,   t_a = Σ_j (D⁻¹)_aj B1ᵀ_j,   S = −c − Σ_a s_a B1ᵀ_a
    double S = mc;
    for (int a = 0; a < n; ++a) {
      const int place = mixed_->place[rows[a]], m = places_.n_velocities[place], i = slot_[rows[a]];
      const Real* const inverse = inverses_.data() + inverse_at_[place];
      double left = 0.0, right = 0.0;
      for (int j = 0; j < m; ++j) {
        const int other = velocities_of(place)[j];
        left += B2_[other] * inverse[j * m + i];
        right += inverse[i * m + j] * B1T_[other];
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
  const MixedRows* mixed_;
  RowsOfPlaces places_;
  std::vector<int> slot_;                ///< of a velocity among those of its place; else -1
  std::vector<std::size_t> inverse_at_;  ///< of each place
  std::vector<Real> inverses_;           ///< m×m of the m velocities of a place, row by row
  std::vector<Real> local_;              ///< s, t and 1/S, patch after patch, one number unused
  std::vector<int> row_of_column_;
  std::vector<char> is_uncovered_;
  std::vector<double> B1T_, B2_, dense_;  ///< of refresh(), as is the rest
  DenseScratch scratch_;
};

}  // namespace

template <class Real>
std::unique_ptr<PatchSolver> make_dense_solver(const CrsMatrix& K, const VankaPatches& patches) {
  return std::make_unique<DenseSolver<Real>>(K, patches);
}
template std::unique_ptr<PatchSolver> make_dense_solver<double>(const CrsMatrix&,
                                                                const VankaPatches&);
template std::unique_ptr<PatchSolver> make_dense_solver<float>(const CrsMatrix&,
                                                               const VankaPatches&);

template <class Real>
std::unique_ptr<PatchSolver> make_diagonal_solver(const CrsMatrix& K, const VankaPatches& patches,
                                                  const MixedRows& mixed) {
  return std::make_unique<DiagonalSolver<Real>>(K, patches, mixed);
}
template std::unique_ptr<PatchSolver> make_diagonal_solver<double>(const CrsMatrix&,
                                                                   const VankaPatches&,
                                                                   const MixedRows&);
template std::unique_ptr<PatchSolver> make_diagonal_solver<float>(const CrsMatrix&,
                                                                  const VankaPatches&,
                                                                  const MixedRows&);

}  // namespace tunica::smoothers
