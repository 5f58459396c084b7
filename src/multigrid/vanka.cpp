#include "multigrid/vanka.hpp"

#include <algorithm>
#include <stdexcept>

#include "base/agreement.hpp"
#include "multigrid/dense_inverse.hpp"
#include "multigrid/independent_set.hpp"

namespace tunica::multigrid {

namespace {

/// Asks for a range of memory without waiting for it.
template <class Real>
void prefetch(const Real* from, const Real* to) {
  constexpr int line = 64 / sizeof(Real);
  for (; from < to; from += line) __builtin_prefetch(from);
}

constexpr int rows_ahead = 6;  ///< of the row in work

/// The rows of a rank's matrix as bare arrays: a sweep visits each of them dozens of times.
struct Rows {
  explicit Rows(const CrsMatrix& K)
      : local(K.getLocalMatrixHost()), start(local.graph.row_map.data()),
        columns(local.graph.entries.data()), values(local.values.data()) {}

  /// True where every row is made of runs of four columns, the unknowns of a node.
  bool are_in_fours() const {
    for (int row = 0; row < local.numRows(); ++row) {
      if ((start[row + 1] - start[row]) % 4 != 0) return false;
      for (std::size_t k = start[row]; k < start[row + 1]; k += 4)
        for (int i = 1; i < 4; ++i)
          if (columns[k + i] != columns[k] + i) return false;
    }
    return true;
  }
  double product(int row, const double* x) const {
    double sum = 0.0;
    for (std::size_t k = start[row]; k < start[row + 1]; ++k) sum += values[k] * x[columns[k]];
    return sum;
  }
  /// The same for runs of four, as four sums that the processor works on side by side.
  double product_of_fours(int row, const double* x) const {
    double sum[4] = {};
    for (std::size_t k = start[row]; k < start[row + 1]; k += 4) {
      const double* const node = x + columns[k];
      for (int i = 0; i < 4; ++i) sum[i] += values[k + i] * node[i];
    }
    return (sum[0] + sum[1]) + (sum[2] + sum[3]);
  }
  void prefetch_row(int row) const {
    prefetch(values + start[row], values + start[row + 1]);
    prefetch(columns + start[row], columns + start[row + 1]);
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

/// y = Σ columns[c] x[c], four columns at a time: y is then read and written a quarter as often.
template <class Real>
void multiply(int n, const Real* columns, const Real* x, Real* y) {
  std::fill_n(y, n, Real(0));
  int c = 0;
  for (; c + 4 <= n; c += 4, columns += 4 * static_cast<std::size_t>(n))
    for (int i = 0; i < n; ++i)
      y[i] += (columns[i] * x[c] + columns[n + i] * x[c + 1]) +
              (columns[2 * n + i] * x[c + 2] + columns[3 * n + i] * x[c + 3]);
  for (; c < n; ++c, columns += n)
    for (int i = 0; i < n; ++i) y[i] += columns[i] * x[c];
}

template <class Real>
class PatchVanka final : public Vanka {
public:
  PatchVanka(const CrsMatrix& K, const std::vector<char>& is_pressure, const VankaOptions& options)
      : K_(&K), options_(options), patches_(make_vanka_patches(K, is_pressure)),
        is_in_fours_(Rows(K).are_in_fours()) {
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
    std::string singular;
    for (int p = 0; p < patches_.n_patches(); ++p) {
      extract(K, p, slot_of_column, dense);
      const int n = patches_.size(p);
      if (!invert_dense(n, dense.data(), exchanged) && singular.empty())
        singular = "the patch of the pressure in" + name(patches_.rows[patches_.start[p + 1] - 1]);
      for (int i = 0; i < n * n; ++i) inverses_[place_[p] + i] = static_cast<Real>(dense[i]);
    }
    for (const int row : patches_.lone_rows)
      if (K.diagonal(row, patches_.column_of_row[row]) == 0.0 && singular.empty())
        singular = "the diagonal of the velocity in" + name(row);
    singular = agreed_message(*K_->getComm(), singular);
    if (!singular.empty()) throw std::runtime_error("Vanka: " + singular + " is singular.");
  }

  void smooth(const MultiVector& b, MultiVector& x) const override {
    MultiVector all(K_->getColMap(), 1);  // own and ghost values
    for (int sweep = 0; sweep < options_.sweeps; ++sweep) {
      fetch_columns(*K_, x, all);
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
  /// Of one patch at a time.
  struct Scratch {
    explicit Scratch(std::size_t size) : residual(size), moves(size) {}
    std::vector<Real> residual, moves;
  };

  /// The patch column by column, which makes its inverse one column by column.
  void extract(const Rows& K, int patch, std::vector<int>& slot_of_column,
               std::vector<double>& dense) const {
    const int n = patches_.size(patch);
    const int* const rows = patches_.rows.data() + patches_.start[patch];
    for (int a = 0; a < n; ++a) slot_of_column[patches_.column_of_row[rows[a]]] = a;
    std::fill_n(dense.begin(), n * n, 0.0);
    for (int a = 0; a < n; ++a)
      for (std::size_t k = K.start[rows[a]]; k < K.start[rows[a] + 1]; ++k) {
        const int slot = slot_of_column[K.columns[k]];
        if (slot >= 0) dense[slot * n + a] = K.values[k];
      }
    for (int a = 0; a < n; ++a) slot_of_column[patches_.column_of_row[rows[a]]] = -1;
  }

  std::string name(int row) const {
    return " row " + std::to_string(K_->getRowMap()->getGlobalElement(row));
  }

  /// One sweep on the own and ghost values x.
  void visit(const double* b, double* x) const {
    const Rows K(*K_);
    for (const int row : patches_.lone_rows) {
      const int column = patches_.column_of_row[row];
      x[column] += (b[row] - K.product(row, x)) / K.diagonal(row, column);
    }
    Scratch scratch(patches_.largest());
    if (options_.is_additive) return visit_at_once(K, b, x, scratch);
    const auto relax = [&](int patch) {
      solve(K, patch, b, x, scratch, [&](int row, double move) {
        x[patches_.column_of_row[row]] += options_.damping * move;
      });
    };
    const int n = patches_.n_patches();
    if (options_.order != "backward")
      for (int p = 0; p < n; ++p) relax(p);
    if (options_.order != "forward")
      for (int p = n - 1; p >= 0; --p) relax(p);
  }

  void visit_at_once(const Rows& K, const double* b, double* x, Scratch& scratch) const {
    std::vector<double> moves(share_.size(), 0.0);
    for (int p = 0; p < patches_.n_patches(); ++p)
      solve(K, p, b, x, scratch, [&](int row, double move) { moves[row] += share_[row] * move; });
    for (std::size_t i = 0; i < moves.size(); ++i)
      x[patches_.column_of_row[i]] += options_.damping * moves[i];
  }

  /// Gives every row of a patch what solves the patch for the present residual.
  template <class Give>
  void solve(const Rows& K, int patch, const double* b, const double* x, Scratch& scratch,
             const Give& give) const {
    const int n = patches_.size(patch);
    const int* const rows = patches_.rows.data() + patches_.start[patch];
    const Real* const inverse = inverses_.data() + place_[patch];
    for (int a = 0; a < n; ++a) {
      // Both come from far while the processor works on the rows at hand.
      prefetch(inverse + a * n, inverse + (a + 1) * n);
      if (a + rows_ahead < n) K.prefetch_row(rows[a + rows_ahead]);
      const double Kx = is_in_fours_ ? K.product_of_fours(rows[a], x) : K.product(rows[a], x);
      scratch.residual[a] = static_cast<Real>(b[rows[a]] - Kx);
    }
    multiply(n, inverse, scratch.residual.data(), scratch.moves.data());
    for (int a = 0; a < n; ++a) give(rows[a], scratch.moves[a]);
  }

  const CrsMatrix* K_;
  VankaOptions options_;
  VankaPatches patches_;
  bool is_in_fours_;
  std::vector<std::size_t> place_;  ///< of each patch's inverse
  std::vector<Real> inverses_;      ///< dense, column by column
  std::vector<double> share_;       ///< 1 / number of patches of a row
};

}  // namespace

std::unique_ptr<Vanka> make_vanka(const CrsMatrix& K, const std::vector<char>& is_pressure,
                                  const VankaOptions& options) {
  if (options.is_single) return std::make_unique<PatchVanka<float>>(K, is_pressure, options);
  return std::make_unique<PatchVanka<double>>(K, is_pressure, options);
}

}  // namespace tunica::multigrid
