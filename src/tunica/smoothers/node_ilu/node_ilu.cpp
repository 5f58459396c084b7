#include "tunica/smoothers/node_ilu/node_ilu.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>

#include "tunica/algebra/columns.hpp"
#include "tunica/base/agreement.hpp"
#include "tunica/smoothers/dense/dense.hpp"
#include "tunica/smoothers/node_ilu/ghost_rows.hpp"
#include "tunica/smoothers/node_ilu/node_blocks.hpp"
#include "tunica/smoothers/node_ilu/node_ilu_sweeps.hpp"

namespace tunica::smoothers {

namespace {

/// Times the entries of K up to which factors with fill are made. Those of meshes have 2.4 to 4.5
/// with two levels of fill; beside multipliers that reach a part of the domain a coarse level would
/// have eight with one, whose elimination takes 14 s in a system of 28,000 unknowns.
constexpr std::size_t most_growth = 6;

double number(double value) { return value; }
double number(Half value) { return widened(value); }
void keep_number(double value, double& kept) { kept = value; }
void keep_number(double value, float& kept) { kept = static_cast<float>(value); }
void keep_number(double value, Half& kept) { kept = rounded(static_cast<float>(value)); }

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
  template <class Stored>
  Stored* keep(int row, int column, const double* block, Stored* kept) const {
    for (int c = width_ - unknowns_[column]; c < width_; ++c)
      for (int i = width_ - unknowns_[row]; i < width_; ++i)
        keep_number(block[width_ * c + i], *kept++);
    return kept;
  }
  /// Makes a block of what is kept of it, and zeros; returns where the next one is.
  template <class Stored>
  const Stored* fill_in(int row, int column, const Stored* kept, double* block) const {
    std::fill_n(block, width_ * width_, 0.0);
    for (int c = width_ - unknowns_[column]; c < width_; ++c)
      for (int i = width_ - unknowns_[row]; i < width_; ++i)
        block[width_ * c + i] = number(*kept++);
    return kept;
  }

private:
  int width_;
  const std::uint8_t* unknowns_;
};

/// Stored: of the blocks of L and U beside the diagonal. Real: of all others, and of what they
/// move; vectors are doubles.
template <class Stored, class Real>
class Factors final : public NodeIlu {
public:
  Factors(const CrsMatrix& K, const algebra::DofLayout& numbering, const NodeIluOptions& options)
      : K_(&K), blocks_(K, numbering, options.hosts), parts_(blocks_.width(), blocks_.unknowns()),
        slot_of_node_(blocks_.n_nodes(), -1) {
    if (options.fill > 0) {
      const RowGraph& graph = blocks_.graph();
      filled_ = with_fill(graph, options.fill, most_growth * graph.columns.size());
      throw_if_any<TooMuchFill>(
          *K.getComm(), filled_ ? ""
                                : "NodalIluSmoother: factors with \"fill\" = " +
                                      std::to_string(options.fill) + " have more than " +
                                      std::to_string(most_growth) + " times the entries of K.");
    }
    make_room();
    unfilled_.resize(size() * longest_row(blocks_.graph()));
    row_.resize(size() * longest_row(graph()));
    x_.resize(static_cast<std::size_t>(blocks_.width()) * blocks_.n_nodes());
    b_.resize(x_.size());
    r_.resize(x_.size());
    move_.resize(x_.size());
    if (K.getComm()->getSize() == 1) return;
    ghosts_.emplace(blocks_);
    x_.resize(x_.size() + ghosts_->n_beyond());
  }

  void refresh(double shift) override {
    shift_ = shift;
    blocks_.refresh();
    if (ghosts_) ghosts_->refresh();
    next_lower_ = lower_values_.data();
    next_kept_ = matrix_.data();
    int singular = -1;
    for (int node = 0; node < blocks_.n_nodes(); ++node)
      if (!eliminate(node) && singular < 0) singular = node;
    std::string message;
    if (singular >= 0)
      message = "NodalIluSmoother: the block of node " + std::to_string(blocks_.number(singular)) +
                " of " + std::to_string(K_->getGlobalNumRows()) +
                " unknowns cannot be inverted in the order of the nodes; systems without "
                "stabilisation need another smoother.";
    // On all ranks if on one: the set-up is collective.
    throw_if_any<std::runtime_error>(*K_->getComm(), message);
  }

  void sweep(const std::vector<double>& dampings, Start start, const MultiVector& b,
             MultiVector& x) override {
    algebra::for_each_column("NodeIlu", b, x, [&](const auto& b_c, auto& x_c) {
      sweep_column(dampings, start, b_c, x_c);
    });
  }

  void residual(const MultiVector& b, const MultiVector& x, MultiVector& r) override {
    algebra::check_columns("NodeIlu", b, x);
    for (std::size_t c = 0; c < b.getNumVectors(); ++c) {
      gather(*b.getVector(c), b_);
      std::fill(x_.begin(), x_.end(), 0.0);
      gather(*x.getVector(c), x_);
      if (ghosts_) ghosts_->fetch(x_);
      find_residual_of_x();
      scatter(r_, *r.getVectorNonConst(c));
    }
  }

  double bytes() const override {
    const auto n_values = inverses_.size() + matrix_.size() + move_.size();
    const auto n_places =
        diagonal_.size() + upper_start_.size() + (filled_ ? filled_->start.size() : 0);
    return static_cast<double>(sizeof(Stored) * (lower_values_.size() + upper_values_.size()) +
                               sizeof(Real) * n_values + 3 * sizeof(double) * x_.size() +
                               sizeof(std::size_t) * n_places +
                               sizeof(int) * (filled_ ? filled_->columns.size() : 0)) +
           blocks_.bytes() + (ghosts_ ? ghosts_->bytes() : 0.0);
  }

private:
  std::size_t size() const { return static_cast<std::size_t>(blocks_.width()) * blocks_.width(); }

  /// Of the factors.
  const RowGraph& graph() const { return filled_ ? *filled_ : blocks_.graph(); }

  BlockPattern pattern(const RowGraph& graph, int n_nodes) const {
    return {blocks_.width(), n_nodes, blocks_.unknowns().data(), graph.start.data(),
            graph.columns.data()};
  }

  // x ← x + ω (L U)⁻¹ (b − K x), sweep after sweep. Only the move is in single precision: where x
  // is large against b, as for stiff springs, the rounding of a single x would outweigh the
  // residual.
  void sweep_column(const std::vector<double>& dampings, Start start, const MultiVector& b,
                    MultiVector& x) {
    gather(b, b_);
    std::fill(x_.begin(), x_.end(), 0.0);
    if (start == Start::given) gather(x, x_);
    for (std::size_t k = 0; k < dampings.size(); ++k) {
      // Of x = 0 r = b: the first product is saved.
      const bool is_zero = k == 0 && start == Start::zero;
      if (ghosts_) fetch_ghosts(is_zero, k == 0);
      if (!is_zero) find_residual_of_x();
      const std::vector<double>& r = is_zero ? b_ : r_;
      for (std::size_t i = 0; i < move_.size(); ++i) move_[i] = static_cast<Real>(r[i]);
      solve_factors(factors(), move_.data());
      const auto n_own = static_cast<std::size_t>(blocks_.width()) * blocks_.n_own_nodes();
      for (std::size_t i = 0; i < n_own; ++i) x_[i] += dampings[k] * move_[i];
    }
    scatter(x_, x);
  }

  // One message a sweep: b of the ghosts' rows, whose residuals are found here, once.
  void fetch_ghosts(bool is_zero, bool is_first) {
    if (is_zero) return ghosts_->fetch(b_);
    if (is_first)
      ghosts_->fetch_halo(x_, b_);
    else
      ghosts_->fetch_halo(x_);
    ghosts_->find_residual(b_, x_, r_);
  }

  /// r = b − K x
  void find_residual_of_x() {
    find_residual(NodeMatrix<Real>{pattern(blocks_.graph(), blocks_.n_own_nodes()), matrix_.data()},
                  b_.data(), x_.data(), r_.data());
  }

  NodeFactors<Stored, Real> factors() const {
    return {pattern(graph(), blocks_.n_nodes()), diagonal_.data(), lower_values_.data(),
            upper_values_.data(), inverses_.data()};
  }

  // Rows of L end before the diagonal, rows of U begin behind it, the last one first, and K has a
  // copy of the own rows. Blocks of nodes with one unknown take one row or column each.
  void make_room() {
    std::size_t lower = 0, upper = 0, matrix = 0;
    upper_start_.resize(blocks_.n_nodes());
    diagonal_.resize(blocks_.n_nodes());
    for (int node = blocks_.n_nodes() - 1; node >= 0; --node) {
      const int* const first = graph().columns.data() + graph().start[node];
      const int* const last = graph().columns.data() + graph().start[node + 1];
      const int* const own = std::lower_bound(first, last, node);
      diagonal_[node] = static_cast<std::size_t>(own - graph().columns.data());
      upper_start_[node] = upper;
      for (const int* column = first; column != own; ++column) lower += parts_.size(node, *column);
      for (const int* column = own + 1; column != last; ++column)
        upper += parts_.size(node, *column);
    }
    for (int node = 0; node < blocks_.n_own_nodes(); ++node)
      for_columns(blocks_.graph(), node, [&](int column) { matrix += parts_.size(node, column); });
    lower_values_.resize(lower);
    upper_values_.resize(upper);
    inverses_.resize(size() * blocks_.n_nodes());
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
    for (std::size_t k = first; k < own; ++k) subtract_row(node, columns[k]);
    double* const block = row_.data() + size() * (own - first);
    const bool is_regular = invert_dense(blocks_.width(), block, scratch_);
    Real* const inverse = inverses_.data() + size() * node;
    const Real* const end = parts_.keep(node, node, block, inverse);
    Stored* const upper = upper_values_.data() + upper_start_[node];
    Stored* next = upper;
    for (std::size_t k = own + 1; k < last; ++k)
      next = parts_.keep(node, columns[k], row_.data() + size() * (k - first), next);
    const auto is_finite = [](auto value) { return std::isfinite(number(value)); };
    return is_regular && std::all_of(inverse, const_cast<Real*>(end), is_finite) &&
           std::all_of(upper, next, is_finite);
  }

  /// The blocks of a node into its row in work, which has room for fill.
  void read_row(int node) {
    for (const int other : row_nodes_) slot_of_node_[other] = -1;
    row_nodes_.clear();
    for_columns(graph(), node, [this](int column) {
      slot_of_node_[column] = static_cast<int>(row_nodes_.size());
      row_nodes_.push_back(column);
    });
    double* const unfilled = filled_ ? unfilled_.data() : row_.data();
    blocks_.read(node, unfilled);
    if (node < blocks_.n_own_nodes()) {
      const double* block = unfilled;
      for_columns(blocks_.graph(), node, [&](int column) {
        next_kept_ = parts_.keep(node, column, block, next_kept_);
        block += size();
      });
    }
    if (filled_) spread_row(node);
    // D_i ← (1 + s) D_i before the elimination; K itself keeps its values for r = b − K x.
    double* const own = row_.data() + size() * slot_of_node_[node];
    for (std::size_t i = 0; i < size(); ++i) own[i] *= 1.0 + shift_;
  }

  /// From the blocks that K has to those of the factors.
  void spread_row(int node) {
    std::fill_n(row_.begin(), size() * row_nodes_.size(), 0.0);
    const double* block = unfilled_.data();
    for_columns(blocks_.graph(), node, [&](int column) {
      std::copy_n(block, size(), row_.data() + size() * slot_of_node_[column]);
      block += size();
    });
  }

  /// Eliminates the column of a node from the row of another in work: L = block · D⁻¹ of that node.
  void subtract_row(int node, int pivot) {
    // L_ik = K_ik D_k⁻¹,   K_i· ← K_i· − L_ik U_k· in the columns that the row has
    double inverse[16], factor[16] = {};
    parts_.fill_in(pivot, pivot, inverses_.data() + size() * pivot, inverse);
    subtract_product(blocks_.width(), row_.data() + size() * slot_of_node_[pivot], inverse, factor);
    for (std::size_t i = 0; i < size(); ++i) factor[i] = -factor[i];
    next_lower_ = parts_.keep(node, pivot, factor, next_lower_);
    subtract_upper(pattern(graph(), blocks_.n_nodes()),
                   UpperRow<Stored>{pivot, diagonal_[pivot] + 1, graph().start[pivot + 1],
                                    upper_values_.data() + upper_start_[pivot]},
                   factor, slot_of_node_.data(), row_.data());
  }

  /// Unknowns that nodes lack, and those of ghosts, stay what they were. Only x_ can have got there
  /// what is no number.
  void gather(const MultiVector& rows, std::vector<double>& values) const {
    const auto& places = blocks_.place_of_row();
    const auto from = rows.getLocalViewHost(read_only);
    for (std::size_t i = 0; i < places.size(); ++i) values[places[i]] = from(i, 0);
  }

  void scatter(const std::vector<double>& values, MultiVector& rows) const {
    const auto& places = blocks_.place_of_row();
    const auto to = rows.getLocalViewHost(overwrite_all);
    for (std::size_t i = 0; i < places.size(); ++i) to(i, 0) = values[places[i]];
  }

  const CrsMatrix* K_;
  NodeBlocks blocks_;
  Parts parts_;
  double shift_ = 0.0;
  std::optional<RowGraph> filled_;
  std::vector<std::size_t> diagonal_, upper_start_;
  std::vector<Stored> lower_values_, upper_values_;
  std::vector<Real> inverses_;             ///< of the diagonal blocks
  std::vector<Real> matrix_;               ///< of the own nodes
  std::vector<double> x_, b_, r_;          ///< by places
  std::vector<Real> move_;                 ///< (L U)⁻¹ r
  std::optional<GhostRows<Real>> ghosts_;  ///< of several ranks
  // of eliminate():
  Stored* next_lower_ = nullptr;
  Real* next_kept_ = nullptr;
  std::vector<int> row_nodes_, slot_of_node_;
  std::vector<double> unfilled_, row_;
  DenseScratch scratch_;
};

}  // namespace

std::unique_ptr<NodeIlu> make_node_ilu(const CrsMatrix& K, const algebra::DofLayout& numbering,
                                       const NodeIluOptions& options) {
  if (numbering.dofs() < 2 || numbering.dofs() > 4)
    throw std::invalid_argument("NodalIluSmoother: vectors of one to three components only.");
  if (options.precision == Precision::half)
    return std::make_unique<Factors<Half, float>>(K, numbering, options);
  if (options.precision == Precision::single)
    return std::make_unique<Factors<float, float>>(K, numbering, options);
  return std::make_unique<Factors<double, double>>(K, numbering, options);
}

}  // namespace tunica::smoothers
