#include "tunica/base/trilinos.hpp"
#include "tunica/smoothers/dense/dense_inverse.hpp"
#include "tunica/smoothers/dense/dense_product.hpp"
#include "tunica/smoothers/vanka/patch_solver.hpp"

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

}  // namespace

template <class Real>
std::unique_ptr<PatchSolver> make_dense_solver(const CrsMatrix& K, const VankaPatches& patches) {
  return std::make_unique<DenseSolver<Real>>(K, patches);
}
template std::unique_ptr<PatchSolver> make_dense_solver<double>(const CrsMatrix&,
                                                                const VankaPatches&);
template std::unique_ptr<PatchSolver> make_dense_solver<float>(const CrsMatrix&,
                                                               const VankaPatches&);

}  // namespace tunica::smoothers
