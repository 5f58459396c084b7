#include "multigrid/vanka.hpp"

#include <algorithm>
#include <stdexcept>

#include "multigrid/dense_inverse.hpp"
#include "multigrid/independent_set.hpp"

namespace tunica::multigrid {

namespace {

/// The rows of a rank's matrix as bare arrays: a sweep visits each of them dozens of times.
struct Rows {
  explicit Rows(const CrsMatrix& K)
      : local(K.getLocalMatrixHost()), start(local.graph.row_map.data()),
        columns(local.graph.entries.data()), values(local.values.data()) {}

  double residual(int row, double b, const double* x) const {
    for (std::size_t k = start[row]; k < start[row + 1]; ++k) b -= values[k] * x[columns[k]];
    return b;
  }
  double diagonal(int row, int column) const {
    for (std::size_t k = start[row]; k < start[row + 1]; ++k)
      if (columns[k] == column) return values[k];
    return 0.0;
  }

  decltype(std::declval<CrsMatrix>().getLocalMatrixHost()) local;  ///< keeps the arrays alive
  const std::size_t* start;
  const int* columns;
  const double* values;
};

template <class Real>
class PatchVanka final : public Vanka {
public:
  PatchVanka(const CrsMatrix& K, const std::vector<char>& is_pressure, const VankaOptions& options)
      : K_(&K), options_(options), patches_(make_vanka_patches(K, is_pressure)) {
    place_.push_back(0);
    for (int p = 0; p < patches_.n_patches(); ++p) {
      const std::size_t n = patches_.size(p);
      place_.push_back(place_.back() + n * n);
    }
    inverses_.resize(place_.back());
    share_.assign(K.getNodeNumRows(), 0.0);
    for (const int row : patches_.rows) share_[row] += 1.0;
    for (double& share : share_)
      if (share > 0.0) share = 1.0 / share;
  }

  void refresh() override {
    const Rows K(*K_);
    const std::size_t most = patches_.largest();
    std::vector<int> slot_of_column(K_->getColMap()->getNodeNumElements(), -1), exchanged;
    std::vector<double> dense(most * most);
    for (int p = 0; p < patches_.n_patches(); ++p) {
      extract(K, p, slot_of_column, dense);
      const int n = patches_.size(p);
      if (!invert_dense(n, dense.data(), exchanged)) throw_singular(p);
      for (int i = 0; i < n * n; ++i) inverses_[place_[p] + i] = static_cast<Real>(dense[i]);
    }
  }

  void smooth(const MultiVector& b, MultiVector& x) const override {
    MultiVector all(K_->getColMap(), 1);  // own and ghost values
    const auto importer = K_->getGraph()->getImporter();
    for (int sweep = 0; sweep < options_.sweeps; ++sweep) {
      if (importer.is_null())
        all.assign(x);
      else
        all.doImport(x, *importer, insert);
      const auto rhs = b.getLocalViewHost(read_only);
      {
        const auto inside = all.getLocalViewHost(read_write);
        visit(rhs.data(), inside.data());
      }
      const auto from = all.getLocalViewHost(read_only);
      const auto to = x.getLocalViewHost(overwrite_all);
      for (std::size_t i = 0; i < to.extent(0); ++i) to(i, 0) = from(patches_.column_of_row[i], 0);
    }
  }

  double bytes() const override {
    return static_cast<double>(inverses_.size() * sizeof(Real) +
                               patches_.rows.size() * sizeof(int) +
                               place_.size() * 2 * sizeof(std::size_t));
  }

private:
  void extract(const Rows& K, int patch, std::vector<int>& slot_of_column,
               std::vector<double>& dense) const {
    const int n = patches_.size(patch);
    const int* const rows = patches_.rows.data() + patches_.start[patch];
    for (int a = 0; a < n; ++a) slot_of_column[patches_.column_of_row[rows[a]]] = a;
    std::fill_n(dense.begin(), n * n, 0.0);
    for (int a = 0; a < n; ++a)
      for (std::size_t k = K.start[rows[a]]; k < K.start[rows[a] + 1]; ++k) {
        const int slot = slot_of_column[K.columns[k]];
        if (slot >= 0) dense[a * n + slot] = K.values[k];
      }
    for (int a = 0; a < n; ++a) slot_of_column[patches_.column_of_row[rows[a]]] = -1;
  }

  [[noreturn]] void throw_singular(int patch) const {
    const int row = patches_.rows[patches_.start[patch + 1] - 1];
    throw std::runtime_error("Vanka: the patch of the pressure in row " +
                             std::to_string(K_->getRowMap()->getGlobalElement(row)) +
                             " is singular.");
  }

  /// One sweep on the own and ghost values x.
  void visit(const double* b, double* x) const {
    const Rows K(*K_);
    for (const int row : patches_.lone_rows) {
      const int column = patches_.column_of_row[row];
      x[column] += K.residual(row, b[row], x) / K.diagonal(row, column);
    }
    std::vector<Real> r(patches_.largest());
    if (options_.is_additive) return visit_at_once(K, b, x, r);
    const auto relax = [&](int patch) {
      solve(K, patch, b, x, r, [&](int row, double move) {
        x[patches_.column_of_row[row]] += options_.damping * move;
      });
    };
    const int n = patches_.n_patches();
    if (options_.order != "backward")
      for (int p = 0; p < n; ++p) relax(p);
    if (options_.order != "forward")
      for (int p = n - 1; p >= 0; --p) relax(p);
  }

  void visit_at_once(const Rows& K, const double* b, double* x, std::vector<Real>& r) const {
    std::vector<double> moves(share_.size(), 0.0);
    for (int p = 0; p < patches_.n_patches(); ++p)
      solve(K, p, b, x, r, [&](int row, double move) { moves[row] += share_[row] * move; });
    for (std::size_t i = 0; i < moves.size(); ++i)
      x[patches_.column_of_row[i]] += options_.damping * moves[i];
  }

  /// Gives every row of a patch what solves the patch for the present residual.
  template <class Give>
  void solve(const Rows& K, int patch, const double* b, const double* x, std::vector<Real>& r,
             const Give& give) const {
    const int n = patches_.size(patch);
    const int* const rows = patches_.rows.data() + patches_.start[patch];
    for (int a = 0; a < n; ++a) r[a] = static_cast<Real>(K.residual(rows[a], b[rows[a]], x));
    const Real* inverse = inverses_.data() + place_[patch];
    for (int a = 0; a < n; ++a, inverse += n) {
      Real move = 0;
      for (int c = 0; c < n; ++c) move += inverse[c] * r[c];
      give(rows[a], move);
    }
  }

  const CrsMatrix* K_;
  VankaOptions options_;
  VankaPatches patches_;
  std::vector<std::size_t> place_;  ///< of each patch's inverse
  std::vector<Real> inverses_;      ///< dense, row by row
  std::vector<double> share_;       ///< 1 / number of patches of a row
};

}  // namespace

std::unique_ptr<Vanka> make_vanka(const CrsMatrix& K, const std::vector<char>& is_pressure,
                                  const VankaOptions& options) {
  if (options.is_single) return std::make_unique<PatchVanka<float>>(K, is_pressure, options);
  return std::make_unique<PatchVanka<double>>(K, is_pressure, options);
}

}  // namespace tunica::multigrid
