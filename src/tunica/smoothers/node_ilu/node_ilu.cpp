#include "tunica/smoothers/node_ilu/node_ilu.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "tunica/algebra/columns.hpp"
#include "tunica/algebra/independent_set.hpp"
#include "tunica/base/agreement.hpp"
#include "tunica/smoothers/dense/dense_inverse.hpp"
#include "tunica/smoothers/node_ilu/node_blocks.hpp"
#include "tunica/smoothers/node_ilu/node_ilu_sweeps.hpp"

namespace tunica::smoothers {

namespace {

template <class Real>
class Factors final : public NodeIlu {
public:
  Factors(const CrsMatrix& K, const algebra::DofLayout& numbering, const NodeIluOptions& options)
      : K_(&K), blocks_(K, numbering, options.hosts), slot_of_node_(blocks_.n_nodes(), -1) {
    split(with_fill(blocks_.graph(), options.fill));
    lower_values_.resize(size() * lower_.columns.size());
    upper_values_.resize(size() * upper_.columns.size());
    inverses_.resize(size() * blocks_.n_nodes());
    unfilled_.resize(size() * longest_row(blocks_.graph()));
    row_.resize(size() * (1 + longest_row(lower_) + longest_row(upper_)));
    matrix_.resize(size() * blocks_.graph().start[blocks_.n_own_nodes()]);
    x_.resize(static_cast<std::size_t>(blocks_.width()) * blocks_.n_nodes());
    r_.resize(x_.size());
  }

  void refresh() override {
    blocks_.refresh();
    int singular = -1;
    for (int node = 0; node < blocks_.n_nodes(); ++node)
      if (!eliminate(node) && singular < 0) singular = node;
    std::string message;
    if (singular >= 0)
      message = "NodalIluSmoother: the block of node " + std::to_string(blocks_.number(singular)) +
                " cannot be inverted in the order of the nodes; systems without stabilisation need "
                "another smoother.";
    throw_if_any<std::runtime_error>(*K_->getComm(), message);
  }

  void smooth(double damping, const MultiVector& b, MultiVector& x) override {
    algebra::for_each_column("NodeIlu", b, x,
                             [&](const auto& b_c, auto& x_c) { smooth_column(damping, b_c, x_c); });
  }

  void smooth_from_zero(double damping, const MultiVector& b, MultiVector& x) override {
    algebra::for_each_column("NodeIlu", b, x, [&](const auto& b_c, auto& x_c) {
      gather(b_c, r_);
      fetch_ghosts(b_c, r_);
      x_c.putScalar(0.0);
      add_solution(damping, x_c);
    });
  }

  double bytes() const override {
    const auto n_values =
        lower_values_.size() + upper_values_.size() + inverses_.size() + matrix_.size();
    return static_cast<double>(sizeof(Real) * n_values + 2 * sizeof(double) * x_.size() +
                               sizeof(int) * (lower_.columns.size() + upper_.columns.size())) +
           blocks_.bytes();
  }

private:
  std::size_t size() const { return static_cast<std::size_t>(blocks_.width()) * blocks_.width(); }

  void smooth_column(double damping, const MultiVector& b, MultiVector& x) {
    gather(b, r_);
    gather(x, x_);
    fetch_ghosts(x, x_);
    // r = b − K x
    subtract_product({blocks_.width(), blocks_.n_own_nodes(), blocks_.graph().start.data(),
                      blocks_.graph().columns.data(), matrix_.data()},
                     x_.data(), r_.data());
    if (has_ghosts()) {
      MultiVector r(b.getMap(), 1);
      const auto& places = blocks_.place_of_row();
      const auto to = r.getLocalViewHost(overwrite_all);
      for (std::size_t i = 0; i < places.size(); ++i) to(i, 0) = r_[places[i]];
      fetch_ghosts(r, r_);
    }
    add_solution(damping, x);
  }

  void split(const RowGraph& graph) {
    for (int node = 0; node < graph.n_rows(); ++node) {
      for (std::size_t k = graph.start[node]; k < graph.start[node + 1]; ++k) {
        const int column = graph.columns[k];
        if (column < node) lower_.columns.push_back(column);
        if (column > node) upper_.columns.push_back(column);
      }
      lower_.start.push_back(lower_.columns.size());
      upper_.start.push_back(upper_.columns.size());
    }
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
    const std::size_t first = lower_.start[node], last = lower_.start[node + 1];
    // K_i· ← K_i· − L_ik U_k· for the nodes k before i, then D_i⁻¹
    for (std::size_t k = first; k < last; ++k)
      subtract_row(lower_.columns[k], lower_values_.data() + size() * k);
    double* const own = row_.data() + size() * (last - first);
    const bool is_regular = invert_dense(blocks_.width(), own, scratch_);
    std::copy_n(own, size(), inverses_.begin() + size() * node);
    std::copy_n(own + size(), size() * (upper_.start[node + 1] - upper_.start[node]),
                upper_values_.begin() + size() * upper_.start[node]);
    const auto is_number = [](Real value) { return std::isfinite(value); };
    return is_regular &&
           std::all_of(inverses_.begin() + size() * node, inverses_.begin() + size() * (node + 1),
                       is_number) &&
           std::all_of(upper_values_.begin() + size() * upper_.start[node],
                       upper_values_.begin() + size() * upper_.start[node + 1], is_number);
  }

  /// The blocks of a node into its row in work, which has room for fill.
  void read_row(int node) {
    for (const int other : row_nodes_) slot_of_node_[other] = -1;
    row_nodes_.assign(lower_.columns.begin() + lower_.start[node],
                      lower_.columns.begin() + lower_.start[node + 1]);
    row_nodes_.push_back(node);
    row_nodes_.insert(row_nodes_.end(), upper_.columns.begin() + upper_.start[node],
                      upper_.columns.begin() + upper_.start[node + 1]);
    for (std::size_t k = 0; k < row_nodes_.size(); ++k)
      slot_of_node_[row_nodes_[k]] = static_cast<int>(k);
    std::fill_n(row_.begin(), size() * row_nodes_.size(), 0.0);
    const RowGraph& graph = blocks_.graph();
    blocks_.read(node, unfilled_.data());
    if (node < blocks_.n_own_nodes())
      std::copy_n(unfilled_.begin(), size() * (graph.start[node + 1] - graph.start[node]),
                  matrix_.begin() + size() * graph.start[node]);
    for (std::size_t k = graph.start[node]; k < graph.start[node + 1]; ++k)
      std::copy_n(unfilled_.begin() + size() * (k - graph.start[node]), size(),
                  row_.begin() + size() * slot_of_node_[graph.columns[k]]);
  }

  /// Eliminates the column of a node from the row in work: L = block · D⁻¹ of that node.
  void subtract_row(int pivot, Real* lower) {
    double inverse[16], factor[16] = {}, other[16];
    std::copy_n(inverses_.begin() + size() * pivot, size(), inverse);
    subtract_product(blocks_.width(), row_.data() + size() * slot_of_node_[pivot], inverse, factor);
    for (std::size_t i = 0; i < size(); ++i) lower[i] = static_cast<Real>(factor[i] = -factor[i]);
    for (std::size_t k = upper_.start[pivot]; k < upper_.start[pivot + 1]; ++k) {
      const int slot = slot_of_node_[upper_.columns[k]];
      if (slot < 0) continue;
      std::copy_n(upper_values_.begin() + size() * k, size(), other);
      subtract_product(blocks_.width(), factor, other, row_.data() + size() * slot);
    }
  }

  /// x += ω U⁻¹ D⁻¹ L⁻¹ r.
  void add_solution(double damping, MultiVector& x) {
    solve_factors({blocks_.width(), blocks_.n_nodes(), lower_.start.data(), upper_.start.data(),
                   lower_.columns.data(), upper_.columns.data(), lower_values_.data(),
                   upper_values_.data(), inverses_.data()},
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
  RowGraph lower_, upper_;
  std::vector<Real> lower_values_, upper_values_, inverses_;
  std::vector<Real> matrix_;   ///< the blocks of the own nodes
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
