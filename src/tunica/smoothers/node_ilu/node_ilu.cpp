#include "tunica/smoothers/node_ilu/node_ilu.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>

#include "tunica/algebra/columns.hpp"
#include "tunica/algebra/independent_set.hpp"
#include "tunica/base/agreement.hpp"
#include "tunica/smoothers/dense/dense.hpp"
#include "tunica/smoothers/node_ilu/node_blocks.hpp"
#include "tunica/smoothers/node_ilu/node_ilu_sweeps.hpp"

namespace tunica::smoothers {

namespace {

/// Blocks of width² values, as they are eliminated, and their parts that are kept: the rows and
/// columns of unknowns that the nodes have, see BlockPattern. Column by column, both.
class Parts {
public:
  Parts(int width, const std::vector<std::uint8_t>& unknowns)
      : width_(width), unknowns_(unknowns.data()) {}

  std::size_t size(int row, int column) const {
    return static_cast<std::size_t>(unknowns_[row]) * unknowns_[column];
  }
  /// Copies what is kept of a block; returns where the next one is.
  template <class Real>
  Real* keep(int row, int column, const double* block, Real* kept) const {
    for (int c = width_ - unknowns_[column]; c < width_; ++c)
      for (int i = width_ - unknowns_[row]; i < width_; ++i)
        *kept++ = static_cast<Real>(block[width_ * c + i]);
    return kept;
  }
  /// Makes a block of what is kept of it, and zeros; returns where the next one is.
  template <class Real>
  const Real* fill_in(int row, int column, const Real* kept, double* block) const {
    std::fill_n(block, width_ * width_, 0.0);
    for (int c = width_ - unknowns_[column]; c < width_; ++c)
      for (int i = width_ - unknowns_[row]; i < width_; ++i) block[width_ * c + i] = *kept++;
    return kept;
  }

private:
  int width_;
  const std::uint8_t* unknowns_;
};

template <class Real>
class Factors final : public NodeIlu {
public:
  Factors(const CrsMatrix& K, const algebra::DofLayout& numbering, const NodeIluOptions& options)
      : K_(&K), blocks_(K, numbering, options.hosts), parts_(blocks_.width(), blocks_.unknowns()),
        slot_of_node_(blocks_.n_nodes(), -1) {
    if (options.fill > 0) filled_ = with_fill(blocks_.graph(), options.fill);
    make_room();
    unfilled_.resize(size() * longest_row(blocks_.graph()));
    row_.resize(size() * longest_row(graph()));
    x_.resize(static_cast<std::size_t>(blocks_.width()) * blocks_.n_nodes());
    r_.resize(x_.size());
  }

  void refresh(double shift) override {
    shift_ = shift;
    blocks_.refresh();
    int singular = -1;
    for (int node = 0; node < blocks_.n_nodes(); ++node)
      if (!eliminate(node) && singular < 0) singular = node;
    std::string message;
    if (singular >= 0)
      message = "NodalIluSmoother: the block of node " + std::to_string(blocks_.number(singular)) +
                " of " + std::to_string(K_->getGlobalNumRows()) +
                " unknowns cannot be inverted in the order of the nodes; systems without "
                "stabilisation need "
                "another smoother.";
    // On all ranks if on one: the set-up is collective.
    throw_if_any<std::runtime_error>(*K_->getComm(), message);
  }

  void smooth(double damping, const MultiVector& b, MultiVector& x) override {
    algebra::for_each_column("NodeIlu", b, x,
                             [&](const auto& b_c, auto& x_c) { smooth_column(damping, b_c, x_c); });
  }

  void smooth_from_zero(double damping, const MultiVector& b, MultiVector& x) override {
    algebra::for_each_column("NodeIlu", b, x, [&](const auto& b_c, auto& x_c) {
      // r = b: the first product is saved.
      gather(b_c, r_);
      fetch_ghosts(b_c, r_);
      x_c.putScalar(0.0);
      add_solution(damping, x_c);
    });
  }

  double bytes() const override {
    const auto n_values = lower_values_.size() + upper_values_.size() + matrix_.size();
    const auto n_places = diagonal_.size() + lower_start_.size() + upper_start_.size() +
                          matrix_start_.size() + (filled_ ? filled_->start.size() : 0);
    return static_cast<double>(sizeof(Real) * n_values + 2 * sizeof(double) * x_.size() +
                               sizeof(std::size_t) * n_places +
                               sizeof(int) * (filled_ ? filled_->columns.size() : 0)) +
           blocks_.bytes();
  }

private:
  std::size_t size() const { return static_cast<std::size_t>(blocks_.width()) * blocks_.width(); }

  /// Of the factors.
  const RowGraph& graph() const { return filled_ ? *filled_ : blocks_.graph(); }

  BlockPattern pattern(const RowGraph& graph, int n_nodes) const {
    return {blocks_.width(), n_nodes, blocks_.unknowns().data(), graph.start.data(),
            graph.columns.data()};
  }

  void smooth_column(double damping, const MultiVector& b, MultiVector& x) {
    gather(b, r_);
    gather(x, x_);
    fetch_ghosts(x, x_);
    // r = b − K x
    subtract_product(NodeMatrix<Real>{pattern(blocks_.graph(), blocks_.n_own_nodes()),
                                      matrix_start_.data(), matrix_.data()},
                     x_.data(), r_.data());
    // Rows of ghosts are not whole here: their owners' residuals take the place of what is missing.
    if (has_ghosts()) {
      MultiVector r(b.getMap(), 1);
      const auto& places = blocks_.place_of_row();
      const auto to = r.getLocalViewHost(overwrite_all);
      for (std::size_t i = 0; i < places.size(); ++i) to(i, 0) = r_[places[i]];
      fetch_ghosts(r, r_);
    }
    add_solution(damping, x);
  }

  // Rows of L end before the diagonal, rows of U begin with it, and K has a copy of the own rows.
  // Blocks of nodes with one unknown take one row or column each.
  void make_room() {
    std::size_t lower = 0, upper = 0, matrix = 0;
    for (auto* places : {&diagonal_, &lower_start_, &upper_start_})
      places->reserve(blocks_.n_nodes());
    matrix_start_.reserve(blocks_.n_own_nodes());
    for (int node = 0; node < blocks_.n_nodes(); ++node) {
      const int* const first = graph().columns.data() + graph().start[node];
      const int* const last = graph().columns.data() + graph().start[node + 1];
      const int* const own = std::lower_bound(first, last, node);
      diagonal_.push_back(static_cast<std::size_t>(own - graph().columns.data()));
      lower_start_.push_back(lower);
      upper_start_.push_back(upper);
      for (const int* column = first; column != own; ++column) lower += parts_.size(node, *column);
      for (const int* column = own; column != last; ++column) upper += parts_.size(node, *column);
    }
    for (int node = 0; node < blocks_.n_own_nodes(); ++node) {
      matrix_start_.push_back(matrix);
      for_columns(blocks_.graph(), node, [&](int column) { matrix += parts_.size(node, column); });
    }
    lower_values_.resize(lower);
    upper_values_.resize(upper);
    matrix_.resize(matrix);
  }

  /// work(node) for the columns of a row.
  template <class Work>
  static void for_columns(const RowGraph& graph, int row, const Work& work) {
    for (std::size_t k = graph.start[row]; k < graph.start[row + 1]; ++k) work(graph.columns[k]);
  }

  std::size_t longest_row(const RowGraph& graph) const {
    std::size_t most = 0;
    for (int node = 0; node < graph.n_rows(); ++node)
      most = std::max(most, graph.start[node + 1] - graph.start[node]);
    return most;
  }

  /// The rows of L and U of a node; those before are known. False where its block is singular.
  bool eliminate(int node) {
    read_row(node);
    const int* const columns = graph().columns.data();
    const std::size_t first = graph().start[node], own = diagonal_[node],
                      last = graph().start[node + 1];
    // K_i· ← K_i· − L_ik U_k· for the nodes k before i, then D_i⁻¹
    Real* lower = lower_values_.data() + lower_start_[node];
    for (std::size_t k = first; k < own; ++k) lower = subtract_row(node, columns[k], lower);
    const bool is_regular =
        invert_dense(blocks_.width(), row_.data() + size() * (own - first), scratch_);
    Real* const upper = upper_values_.data() + upper_start_[node];
    Real* next = upper;
    for (std::size_t k = own; k < last; ++k)
      next = parts_.keep(node, columns[k], row_.data() + size() * (k - first), next);
    return is_regular && std::all_of(upper, next, [](Real value) { return std::isfinite(value); });
  }

  /// The blocks of a node into its row in work, which has room for fill.
  void read_row(int node) {
    for (const int other : row_nodes_) slot_of_node_[other] = -1;
    row_nodes_.clear();
    for_columns(graph(), node, [this](int column) {
      slot_of_node_[column] = static_cast<int>(row_nodes_.size());
      row_nodes_.push_back(column);
    });
    std::fill_n(row_.begin(), size() * row_nodes_.size(), 0.0);
    blocks_.read(node, unfilled_.data());
    const double* block = unfilled_.data();
    Real* kept = node < blocks_.n_own_nodes() ? matrix_.data() + matrix_start_[node] : nullptr;
    for_columns(blocks_.graph(), node, [&](int column) {
      if (kept != nullptr) kept = parts_.keep(node, column, block, kept);
      double* const to = row_.data() + size() * slot_of_node_[column];
      std::copy_n(block, size(), to);
      // D_i ← (1 + s) D_i before the elimination; K itself keeps its values for r = b − K x.
      if (column == node)
        for (std::size_t i = 0; i < size(); ++i) to[i] *= 1.0 + shift_;
      block += size();
    });
  }

  /// Eliminates the column of a node from the row of another in work: L = block · D⁻¹ of that node.
  /// Returns where the next block of L is kept.
  Real* subtract_row(int node, int pivot, Real* lower) {
    // L_ik = K_ik D_k⁻¹,   K_i· ← K_i· − L_ik U_k· in the columns that the row has
    double inverse[16], factor[16] = {}, other[16];
    const Real* upper =
        parts_.fill_in(pivot, pivot, upper_values_.data() + upper_start_[pivot], inverse);
    subtract_product(blocks_.width(), row_.data() + size() * slot_of_node_[pivot], inverse, factor);
    for (std::size_t i = 0; i < size(); ++i) factor[i] = -factor[i];
    lower = parts_.keep(node, pivot, factor, lower);
    for (std::size_t k = diagonal_[pivot] + 1; k < graph().start[pivot + 1]; ++k) {
      const int column = graph().columns[k], slot = slot_of_node_[column];
      if (slot < 0) {
        upper += parts_.size(pivot, column);
        continue;
      }
      upper = parts_.fill_in(pivot, column, upper, other);
      subtract_product(blocks_.width(), factor, other, row_.data() + size() * slot);
    }
    return lower;
  }

  /// x += ω U⁻¹ D⁻¹ L⁻¹ r.
  void add_solution(double damping, MultiVector& x) {
    solve_factors(NodeFactors<Real>{pattern(graph(), blocks_.n_nodes()), diagonal_.data(),
                                    lower_start_.data(), upper_start_.data(), lower_values_.data(),
                                    upper_values_.data()},
                  r_.data());
    const auto& places = blocks_.place_of_row();
    const auto to = x.getLocalViewHost(read_write);
    for (std::size_t i = 0; i < places.size(); ++i) to(i, 0) += damping * r_[places[i]];
  }

  bool has_ghosts() const { return K_->getComm()->getSize() > 1; }

  void gather(const MultiVector& rows, std::vector<double>& values) const {
    const auto& places = blocks_.place_of_row();
    const auto from = rows.getLocalViewHost(read_only);
    std::fill(values.begin(), values.end(), 0.0);
    for (std::size_t i = 0; i < places.size(); ++i) values[places[i]] = from(i, 0);
  }

  void fetch_ghosts(const MultiVector& rows, std::vector<double>& values) const {
    if (!has_ghosts()) return;
    MultiVector all(K_->getColMap(), 1);
    algebra::fetch_columns(*K_, rows, all);
    const auto from = all.getLocalViewHost(read_only);
    const auto& columns = blocks_.ghost_columns();
    for (std::size_t i = 0; i < columns.size(); ++i)
      values[blocks_.ghost_places()[i]] = from(columns[i], 0);
  }

  const CrsMatrix* K_;
  NodeBlocks blocks_;
  Parts parts_;
  double shift_ = 0.0;
  std::optional<RowGraph> filled_;
  std::vector<std::size_t> diagonal_, lower_start_, upper_start_, matrix_start_;
  std::vector<Real> lower_values_, upper_values_;
  std::vector<Real> matrix_;   ///< of the own nodes
  std::vector<double> x_, r_;  ///< of smooth(): by places
  // of eliminate():
  std::vector<int> row_nodes_, slot_of_node_;
  std::vector<double> unfilled_, row_;
  DenseScratch scratch_;
};

}  // namespace

std::unique_ptr<NodeIlu> make_node_ilu(const CrsMatrix& K, const algebra::DofLayout& numbering,
                                       const NodeIluOptions& options) {
  if (numbering.dofs() < 2 || numbering.dofs() > 4)
    throw std::invalid_argument("NodalIluSmoother: vectors of one to three components only.");
  if (options.is_single) return std::make_unique<Factors<float>>(K, numbering, options);
  return std::make_unique<Factors<double>>(K, numbering, options);
}

}  // namespace tunica::smoothers
