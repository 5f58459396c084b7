#include "tunica/smoothers/vanka/patch_rows.hpp"

#include <algorithm>
#include <cstring>

#include "tunica/base/clones.hpp"
#include "tunica/base/trilinos.hpp"

namespace tunica::smoothers {

namespace {

/// The matrix itself, as bare arrays.
class PlainRows final : public PatchRows {
public:
  explicit PlainRows(const CrsMatrix& K) : K_(&K), local_(K.getLocalMatrixHost()) {}

  void refresh() override { local_ = K_->getLocalMatrixHost(); }
  void residual(const int* rows, int n, const double* b, const double* x, double* r,
                const PrefetchRange& ahead) const override {
    const std::size_t* const start = local_.graph.row_map.data();
    const int* const columns = local_.graph.entries.data();
    const double* const values = local_.values.data();
    for (int a = 0; a < n; ++a) {
      prefetch(ahead, a, a + 1, n);
      double Kx = 0.0;
      for (std::size_t k = start[rows[a]]; k < start[rows[a] + 1]; ++k)
        Kx += values[k] * x[columns[k]];
      r[a] = b[rows[a]] - Kx;
    }
  }
  double bytes() const override { return 0.0; }

private:
  const CrsMatrix* K_;
  decltype(std::declval<CrsMatrix>().getLocalMatrixHost()) local_;
};

/// Rows of a matrix with the unknowns 4*node + i, the pressure last, copied as blocks of a node's
/// rows and a node's columns: one column number for all entries of a block, and sums of four
/// products that the processor works on side by side. Entries that K lacks are zeros.
///
/// The pressure row is apart: a patch has the velocity rows of many nodes, the pressure row of
/// one.
class NodeRows final : public PatchRows {
public:
  static bool can_hold(const CrsMatrix& K, const std::vector<char>& is_pressure);

  explicit NodeRows(const CrsMatrix& K);
  void refresh() override;
  void residual(const int* rows, int n, const double* b, const double* x, double* r,
                const PrefetchRange& ahead) const override;
  double bytes() const override;

private:
  void find_blocks();

  const CrsMatrix* K_;
  std::vector<std::size_t> start_;  ///< of each node's blocks
  std::vector<int> columns_;        ///< of each block: the first of its four
  std::vector<double> velocity_;    ///< 3×4 of each block, row by row
  std::vector<double> pressure_;    ///< 1×4 of each block
  std::vector<int> block_of_node_;  ///< scratch of refresh(): by the columns' nodes
};

/// Four doubles that the processor adds and multiplies in one step where it can, at any address.
using Four = double __attribute__((vector_size(32), aligned(8), may_alias));

/// References only: functions for different processors pass and return such values differently.
[[gnu::always_inline]] inline const Four& four(const double* from) {
  return *reinterpret_cast<const Four*>(from);
}
[[gnu::always_inline]] inline double sum(const Four& v) { return (v[0] + v[1]) + (v[2] + v[3]); }

struct Blocks {
  const std::size_t* start;
  const int* columns;
  const double *velocity, *pressure;
};

/// The three velocity rows of a node. Two sums per row: the processor need not wait for the last.
[[gnu::always_inline]] inline void velocity_products(const Blocks& K, int node, const double* x,
                                                     double* y) {
  Four even[3] = {}, odd[3] = {};
  std::size_t k = K.start[node];
  const std::size_t end = K.start[node + 1];
  for (; k + 2 <= end; k += 2) {
    const Four &x_even = four(x + K.columns[k]), &x_odd = four(x + K.columns[k + 1]);
    const double* const block = K.velocity + 12 * k;
    for (int i = 0; i < 3; ++i) {
      even[i] += four(block + 4 * i) * x_even;
      odd[i] += four(block + 12 + 4 * i) * x_odd;
    }
  }
  if (k < end)
    for (int i = 0; i < 3; ++i)
      even[i] += four(K.velocity + 12 * k + 4 * i) * four(x + K.columns[k]);
  for (int i = 0; i < 3; ++i) {
    even[i] += odd[i];
    y[i] = sum(even[i]);
  }
}

[[gnu::always_inline]] inline double pressure_product(const Blocks& K, int node, const double* x) {
  Four all = {};
  for (std::size_t k = K.start[node]; k < K.start[node + 1]; ++k)
    all += four(K.pressure + 4 * k) * four(x + K.columns[k]);
  return sum(all);
}

TUNICA_CLONES void residual_of_nodes(const Blocks& K, const int* rows, int n, const double* b,
                                     const double* x, double* r, const PrefetchRange& ahead) {
  // r = b − K x. A node's velocity rows are read together, for as many as the patch has.
  for (int a = 0; a < n;) {
    const int first = a, node = rows[a] / 4;
    if (rows[a] % 4 == 3) {
      r[a++] = b[4 * node + 3] - pressure_product(K, node, x);
    } else {
      double Kx[3];
      velocity_products(K, node, x, Kx);
      for (; a < n && rows[a] / 4 == node && rows[a] % 4 != 3; ++a)
        r[a] = b[rows[a]] - Kx[rows[a] % 4];
    }
    prefetch(ahead, first, a, n);
  }
}

bool NodeRows::can_hold(const CrsMatrix& K, const std::vector<char>& is_pressure) {
  const Map& columns = *K.getColMap();
  const auto numbers = global_numbers(columns);
  if (numbers.size() % 4 != 0 || is_pressure.size() % 4 != 0) return false;
  // Columns come as whole nodes, 4 node + 0 … 3, and each fourth row is a pressure.
  for (int i = 0; i < numbers.size(); ++i)
    if (numbers[i] != numbers[i - i % 4] + i % 4) return false;
  for (std::size_t i = 0; i < is_pressure.size(); ++i)
    if ((i % 4 == 3) != (is_pressure[i] != 0)) return false;
  return true;
}

NodeRows::NodeRows(const CrsMatrix& K) : K_(&K), block_of_node_(n_local(*K.getColMap()) / 4, -1) {
  find_blocks();
  velocity_.resize(12 * columns_.size());
  pressure_.resize(4 * columns_.size());
}

// A block for each pair of nodes between which any of the 4×4 entries is in the graph
void NodeRows::find_blocks() {
  const auto local = K_->getLocalMatrixHost();
  start_.push_back(0);
  for (int node = 0; node < local.numRows() / 4; ++node) {
    for (int i = 0; i < 4; ++i) {
      const auto row = local.rowConst(4 * node + i);
      for (int k = 0; k < row.length; ++k) {
        int& block = block_of_node_[row.colidx(k) / 4];
        if (block >= 0) continue;
        block = 0;
        columns_.push_back(row.colidx(k) / 4 * 4);
      }
    }
    std::sort(columns_.begin() + static_cast<std::ptrdiff_t>(start_.back()), columns_.end());
    for (std::size_t k = start_.back(); k < columns_.size(); ++k)
      block_of_node_[columns_[k] / 4] = -1;
    start_.push_back(columns_.size());
  }
}

void NodeRows::refresh() {
  const auto local = K_->getLocalMatrixHost();
  std::fill(velocity_.begin(), velocity_.end(), 0.0);
  std::fill(pressure_.begin(), pressure_.end(), 0.0);
  for (int node = 0; node < local.numRows() / 4; ++node) {
    for (std::size_t k = start_[node]; k < start_[node + 1]; ++k)
      block_of_node_[columns_[k] / 4] = static_cast<int>(k);
    for (int i = 0; i < 4; ++i) {
      const auto row = local.rowConst(4 * node + i);
      for (int k = 0; k < row.length; ++k) {
        const int column = row.colidx(k);
        const std::size_t block = block_of_node_[column / 4];
        (i < 3 ? velocity_[12 * block + 4 * i + column % 4] : pressure_[4 * block + column % 4]) =
            row.value(k);
      }
    }
  }
}

void NodeRows::residual(const int* rows, int n, const double* b, const double* x, double* r,
                        const PrefetchRange& ahead) const {
  residual_of_nodes({start_.data(), columns_.data(), velocity_.data(), pressure_.data()}, rows, n,
                    b, x, r, ahead);
}

double NodeRows::bytes() const {
  return static_cast<double>(sizeof(double) * (velocity_.size() + pressure_.size()) +
                             sizeof(int) * (columns_.size() + block_of_node_.size()) +
                             sizeof(std::size_t) * start_.size());
}

}  // namespace

std::unique_ptr<PatchRows> make_patch_rows(const CrsMatrix& K,
                                           const std::vector<char>& is_pressure) {
  if (NodeRows::can_hold(K, is_pressure)) return std::make_unique<NodeRows>(K);
  return std::make_unique<PlainRows>(K);
}

}  // namespace tunica::smoothers
