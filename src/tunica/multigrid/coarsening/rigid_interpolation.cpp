#include "tunica/multigrid/coarsening/rigid_interpolation.hpp"

#include <Teuchos_LAPACK.hpp>
#include <algorithm>
#include <cmath>
#include <utility>

#include "tunica/base/trilinos.hpp"

namespace tunica::multigrid {

namespace {

constexpr std::size_t most_nodes = 6;   ///< whose displacements tell a rotation
constexpr double least_spread = 0.3;    ///< second over first extent of nodes that span a plane
constexpr double least_widening = 0.1;  ///< of the second extent, in parts of the first
constexpr double least_inertia = 0.01;  ///< of Σ |d|²: about the line on which nodes lie

Mat3 cross_matrix(const Vec3& a) {
  return {{{0, -a[2], a[1]}, {a[2], 0, -a[0]}, {-a[1], a[0], 0}}};
}

/// Eigenvalues, ascending, and eigenvectors of Σ d dᵀ.
struct Extents {
  std::array<double, 3> squares{};
  std::array<Vec3, 3> axes{};
  double sum = 0.0;

  explicit Extents(const std::vector<Vec3>& offsets) {
    double S[9] = {}, work[16];
    for (const Vec3& d : offsets)
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) S[3 * j + i] += d[i] * d[j];
    int info = 0;
    Teuchos::LAPACK<int, double>().SYEV('V', 'U', 3, S, 3, squares.data(), work, 16, &info);
    for (int k = 0; k < 3; ++k) {
      axes[k] = {S[3 * k], S[3 * k + 1], S[3 * k + 2]};
      sum += squares[k];
    }
  }
  double extent(int k) const { return std::sqrt(std::max(squares[k], 0.0)); }
  double spread() const { return squares[2] > 0.0 ? extent(1) / extent(2) : 0.0; }
  /// Pseudo-inverse of Σ (|d|² I − d dᵀ).
  Mat3 inverse_inertia() const {
    Mat3 inverse{};
    for (int k = 0; k < 3; ++k) {
      const double inertia = sum - squares[k];
      if (!(inertia > least_inertia * sum)) continue;
      for (int i = 0; i < 3; ++i) inverse[i] += (axes[k][i] / inertia) * axes[k];
    }
    return inverse;
  }
};

/// A coarse node as the rows of a rank see it.
struct CoarseNode {
  Vec3 x;
  GlobalOrdinal number;
};

std::vector<Vec3> offsets_from_mean(const std::vector<CoarseNode>& nodes) {
  Vec3 mean{};
  for (const CoarseNode& node : nodes) mean += (1.0 / static_cast<double>(nodes.size())) * node.x;
  std::vector<Vec3> offsets;
  for (const CoarseNode& node : nodes) offsets.push_back(node.x - mean);
  return offsets;
}

/// Coordinates in three columns and a flag in the fourth, on the columns of a graph.
class Columns {
public:
  Columns(const CrsGraph& graph, const MultiVector& x, const Teuchos::RCP<const Vector>& between)
      : numbers_(global_numbers(*graph.getColMap())), all_(graph.getColMap(), 4) {
    MultiVector own(graph.getDomainMap(), 4);
    {
      const auto to = own.getLocalViewHost(overwrite_all);
      const auto from = x.getLocalViewHost(read_only);
      for (std::size_t a = 0; a < to.extent(0); ++a) {
        for (int i = 0; i < 3; ++i) to(a, i) = from(a, i);
        to(a, 3) = between.is_null() ? 0.0 : between->getLocalViewHost(read_only)(a, 0);
      }
    }
    all_.doImport(own, Import(graph.getDomainMap(), graph.getColMap()), insert);
    view_ = all_.getLocalViewHost(read_only);
  }
  CoarseNode operator[](int c) const {
    return {{view_(c, 0), view_(c, 1), view_(c, 2)}, numbers_[c]};
  }
  bool is_between(int c) const { return view_(c, 3) != 0.0; }

private:
  Teuchos::ArrayView<const GlobalOrdinal> numbers_;
  MultiVector all_;
  decltype(std::declval<const MultiVector&>().getLocalViewHost(read_only)) view_;
};

/// The terms of one fine node.
class Fit {
public:
  Fit(const Vec3& x, std::vector<CoarseNode> parents) : x_(x), nodes_(std::move(parents)) {
    n_parents_ = nodes_.size();
  }
  /// Takes further nodes, the nearest first, until all span a plane; but none that lies as good as
  /// in their line or between them, as those above and below in a wall of many layers do. Ties are
  /// broken by places: the numbers of nodes differ with the ranks.
  void extend(std::vector<CoarseNode> others) {
    const auto distance = [this](const CoarseNode& node) { return dot(node.x - x_, node.x - x_); };
    std::sort(others.begin(), others.end(), [&](const CoarseNode& a, const CoarseNode& b) {
      return std::make_pair(distance(a), a.x) < std::make_pair(distance(b), b.x);
    });
    for (const CoarseNode& node : others) {
      if (nodes_.size() >= most_nodes || spans_plane()) return;
      if (nodes_.size() < 2 || is_widened_by(node)) nodes_.push_back(node);
    }
  }
  bool spans_plane() const {
    return nodes_.size() > 2 && Extents(offsets_from_mean(nodes_)).spread() >= least_spread;
  }
  void append_to(RigidInterpolation& result) const {
    const std::vector<Vec3> d = offsets_from_mean(nodes_);
    Vec3 arm = x_;  // x_i − x̄_i
    const double share = 1.0 / static_cast<double>(n_parents_);
    for (std::size_t k = 0; k < n_parents_; ++k) arm = arm - share * nodes_[k].x;
    // θ × arm = −[arm]× T⁻¹ Σ [d_k]× u_k
    const Mat3 turn = cross_matrix(-1.0 * arm) * Extents(d).inverse_inertia();
    for (std::size_t k = 0; k < nodes_.size(); ++k) {
      Mat3 block = turn * cross_matrix(d[k]);
      for (int i = 0; i < 3 && k < n_parents_; ++i) block[i][i] += share;
      result.nodes.push_back(nodes_[k].number);
      result.blocks.push_back(block);
    }
  }

private:
  bool is_widened_by(const CoarseNode& node) const {
    std::vector<CoarseNode> with = nodes_;
    with.push_back(node);
    const Extents before(offsets_from_mean(nodes_)), after(offsets_from_mean(with));
    return after.extent(2) > 1.5 * before.extent(2) ||
           after.extent(1) > before.extent(1) + least_widening * after.extent(2);
  }

  Vec3 x_;
  std::vector<CoarseNode> nodes_;  ///< the parents first
  std::size_t n_parents_ = 0;
};

std::vector<char> flags_of(const std::vector<int>& rows, std::size_t n) {
  std::vector<char> flags(n, 0);
  for (const int row : rows) flags[row] = 1;
  return flags;
}

}  // namespace

RigidInterpolation rigid_interpolation(const RigidSource& source) {
  const Columns columns(source.second, *source.coarse.coordinates, source.coarse_between);
  const auto P = source.P.getLocalMatrixHost();
  const auto second = source.second.getLocalGraphHost();
  const auto x = source.fine.coordinates->getLocalViewHost(read_only);
  const auto in_solid = source.fine.in_solid->getLocalViewHost(read_only);
  const std::vector<char> is_coarse = flags_of(source.coarse_rows, x.extent(0));
  const Map &own = *source.P.getColMap(), &all = *source.second.getColMap();
  RigidInterpolation result;
  std::vector<char> is_parent(n_local(all), 0);
  for (std::size_t i = 0; i < x.extent(0); ++i) {
    result.start.push_back(result.nodes.size());
    const auto row = P.rowConst(static_cast<int>(i));
    if (is_coarse[i] || in_solid(i, 0) == 0.0 || row.length == 0) continue;
    std::vector<CoarseNode> parents, others;
    std::vector<int> places;
    for (int k = 0; k < row.length; ++k) {
      places.push_back(all.getLocalElement(own.getGlobalElement(row.colidx(k))));
      parents.push_back(columns[places.back()]);
      is_parent[places.back()] = 1;
    }
    const bool is_between = !source.fine_between.is_null() &&
                            source.fine_between->getLocalViewHost(read_only)(i, 0) != 0.0;
    for (auto k = second.row_map(i); k < second.row_map(i + 1); ++k) {
      const int c = second.entries(k);
      if (!is_parent[c] && (!is_between || columns.is_between(c))) others.push_back(columns[c]);
    }
    for (const int c : places) is_parent[c] = 0;
    Fit fit({x(i, 0), x(i, 1), x(i, 2)}, std::move(parents));
    fit.extend(std::move(others));
    fit.append_to(result);
  }
  result.start.push_back(result.nodes.size());
  return result;
}

}  // namespace tunica::multigrid
