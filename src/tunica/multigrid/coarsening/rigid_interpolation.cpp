#include "tunica/multigrid/coarsening/rigid_interpolation.hpp"

#include <Teuchos_LAPACK.hpp>
#include <algorithm>
#include <cmath>
#include <optional>
#include <tuple>
#include <utility>

#include "tunica/algebra/products/sparse_product.hpp"
#include "tunica/base/agreement.hpp"
#include "tunica/base/reduce.hpp"
#include "tunica/base/trilinos.hpp"

namespace tunica::multigrid {

namespace {

/// Cosine of the angle within which a node hides those behind it. Iterations of a wall with six
/// layers of 15 : 1 by 0.3, 0.5, 0.7: 33, 30, 29 (the nearest twelve: 25); by the last the next
/// level of a pulse in a tube costs a quarter more.
constexpr double shadow = 0.6;
constexpr double blunt = 0.05;          ///< of weights by distance, in parts of h²
constexpr double leniency = 0.01;       ///< ε
constexpr double least_spread = 0.3;    ///< second over first extent of nodes that span a plane
constexpr double exact = 0.02;          ///< τ of means
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
    // S = Q diag(λ) Qᵀ, λ ascending
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
    // T = (tr S) I − S with S = Σ d dᵀ has the axes of S and the values tr S − λ_k.
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
  Vec3 from{};            ///< its offset from the fine node
  double distance = 0.0;  ///< |from|
};

std::vector<Vec3> offsets_from_mean(const std::vector<CoarseNode>& nodes) {
  // d_k = x_k − Σ_l x_l/n
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
  /// Of the coarse nodes around it.
  Fit(const Vec3& x, std::vector<CoarseNode> around) : x_(x) {
    for (CoarseNode& node : around) {
      node.from = node.x - x_;
      node.distance = norm(node.from);
    }
    // Ties are broken by places: the numbers of nodes differ with the ranks.
    std::sort(around.begin(), around.end(), [](const CoarseNode& a, const CoarseNode& b) {
      return std::tie(a.distance, a.x) < std::tie(b.distance, b.x);
    });
    // The nearest node of each direction first. Those behind are added, the nearest first, only as
    // long as the others do not span a plane.
    std::vector<CoarseNode> hidden;
    for (const CoarseNode& node : around)
      (is_behind_another(node) ? hidden : nodes_).push_back(node);
    for (const CoarseNode& node : hidden) {
      if (find_spread()) return;
      nodes_.push_back(node);
    }
    find_spread();
  }
  /// Else the rotation about their line is not known.
  bool spans_plane() const { return spans_plane_; }
  void append_to(RigidInterpolation& result) const {
    const std::vector<double> phi = weights();
    Vec3 arm = x_;  // x_i − Σ φ_k x_k
    for (std::size_t k = 0; k < nodes_.size(); ++k) arm = arm - phi[k] * nodes_[k].x;
    // θ × arm = −[arm]× T⁻¹ Σ [d_k]× u_k
    const std::vector<Vec3> d = offsets_from_mean(nodes_);
    const Mat3 turn = cross_matrix(-1.0 * arm) * Extents(d).inverse_inertia();
    for (std::size_t k = 0; k < nodes_.size(); ++k) {
      Mat3 block = turn * cross_matrix(d[k]);
      for (int i = 0; i < 3; ++i) block[i][i] += phi[k];
      result.nodes.push_back(nodes_[k].number);
      result.blocks.push_back(block);
    }
  }

private:
  /// φ_k = w_k (1 + λ₀ + λ·d_k) with d_k = x_k − x_i and
  ///   Σ w_k (λ₀ + λ·d_k)                    = 0
  ///   Σ w_k (λ₀ + λ·d_k) d_k + ε h² λ = −Σ w_k d_k
  std::vector<double> weights() const {
    const std::size_t n = nodes_.size();
    std::vector<double> w(n);
    // w_k ~ (|x_k − x_i|²/h² + 0.05)⁻², h² the mean of |x_k − x_i|²
    double h2 = 0.0, sum = 0.0;
    for (const CoarseNode& node : nodes_) h2 += dot(node.from, node.from) / static_cast<double>(n);
    for (std::size_t k = 0; k < n; ++k) {
      const Vec3& d = nodes_[k].from;
      w[k] = std::pow(dot(d, d) / h2 + blunt, -2.0);
      sum += w[k];
    }
    // Normal equations of λ₀ and λ; ε h² makes them definite where nodes lie in a plane.
    double A[16] = {}, b[4] = {};
    for (std::size_t k = 0; k < n; ++k) {
      w[k] /= sum;
      const Vec3& d = nodes_[k].from;
      const double row[4] = {1.0, d[0], d[1], d[2]};
      for (int i = 0; i < 4; ++i) {
        if (i > 0) b[i] -= w[k] * row[i];
        for (int j = 0; j < 4; ++j) A[4 * j + i] += w[k] * row[i] * row[j];
      }
    }
    for (int i = 1; i < 4; ++i) A[5 * i] += leniency * h2;
    int info = 0;
    Teuchos::LAPACK<int, double>().POSV('U', 4, 1, A, 4, b, 4, &info);
    // Σ φ_k = 1 to the last digit: translations are exact.
    double total = 0.0;
    for (std::size_t k = 0; k < n; ++k) {
      const Vec3& d = nodes_[k].from;
      w[k] *= 1.0 + b[0] + b[1] * d[0] + b[2] * d[1] + b[3] * d[2];
      total += w[k];
    }
    for (double& weight : w) weight /= total;
    return w;
  }

  bool find_spread() {
    spans_plane_ = nodes_.size() > 2 && Extents(offsets_from_mean(nodes_)).spread() >= least_spread;
    return spans_plane_;
  }

  bool is_behind_another(const CoarseNode& node) const {
    // cos∠(d, e) ≥ 0.6 for a nearer node at e
    return std::any_of(nodes_.begin(), nodes_.end(), [&](const CoarseNode& other) {
      return dot(node.from, other.from) >= shadow * node.distance * other.distance;
    });
  }

  Vec3 x_;
  std::vector<CoarseNode> nodes_;
  bool spans_plane_ = false;
};

std::vector<char> flags_of(const std::vector<int>& rows, std::size_t n) {
  std::vector<char> flags(n, 0);
  for (const int row : rows) flags[row] = 1;
  return flags;
}

/// Makes the fits of a rank's fine nodes.
class Fits {
public:
  explicit Fits(const RigidSource& source) : source_(source) {
    const auto x = source.fine.coordinates->getLocalViewHost(read_only);
    const auto in_solid = source.fine.in_solid->getLocalViewHost(read_only);
    // Fitted are nodes of solids that do not stay, unless they are left out of the next level.
    const std::vector<char> is_coarse = flags_of(source.coarse_rows, x.extent(0));
    for (std::size_t i = 0; i < x.extent(0); ++i) {
      places_.push_back({x(i, 0), x(i, 1), x(i, 2)});
      is_fitted_.push_back(!is_coarse[i] && in_solid(i, 0) != 0.0 &&
                           source.P.getNumEntriesInLocalRow(static_cast<int>(i)) > 0);
    }
    fits_.resize(places_.size());
    if (source.keeps_exact_means) leave_exact_means();
  }

  /// Of fitted nodes that do not span a plane yet, to the coarse nodes in their rows. Collective.
  void fit(const CrsGraph& around) {
    const Columns columns(around, *source_.coarse.coordinates, source_.coarse_between);
    const auto rows = around.getLocalGraphHost();
    for (std::size_t i = 0; i < fits_.size(); ++i) {
      if (!is_open(i)) continue;
      const bool is_between = !source_.fine_between.is_null() &&
                              source_.fine_between->getLocalViewHost(read_only)(i, 0) != 0.0;
      std::vector<CoarseNode> nodes;
      for (auto k = rows.row_map(i); k < rows.row_map(i + 1); ++k)
        if (!is_between || columns.is_between(rows.entries(k)))
          nodes.push_back(columns[rows.entries(k)]);
      fits_[i].emplace(places_[i], std::move(nodes));
    }
  }

  /// The graph of the nodes beside those that do not span a plane; no rows of others. Collective.
  /// Null where there are none on any rank.
  Teuchos::RCP<CrsMatrix> beside_open() const {
    const CrsGraph& nodes = source_.nodes;
    const auto graph = nodes.getLocalGraphHost();
    const auto result =
        Teuchos::rcp(new CrsMatrix(nodes.getRowMap(), nodes.getColMap(), longest_local_row(nodes)));
    bool has_any = false;
    for (std::size_t i = 0; i < fits_.size(); ++i)
      for (auto k = graph.row_map(i); is_open(i) && k < graph.row_map(i + 1); ++k) {
        result->insertLocalValues(static_cast<int>(i), Teuchos::tuple<int>(graph.entries(k)),
                                  Teuchos::tuple(1.0));
        has_any = true;
      }
    if (all_agree(*nodes.getComm(), !has_any)) return Teuchos::null;
    result->fillComplete(nodes.getDomainMap(), nodes.getRangeMap());
    return result;
  }

  RigidInterpolation result() const {
    RigidInterpolation result;
    for (const std::optional<Fit>& fit : fits_) {
      result.start.push_back(result.nodes.size());
      if (fit) fit->append_to(result);
    }
    result.start.push_back(result.nodes.size());
    return result;
  }

private:
  // |x_i − Σ_k x_k/n|² ≤ τ² h², over the n parents k of i; h² mean of |x_k − x_i|²
  void leave_exact_means() {
    const Columns columns(*source_.P.getCrsGraph(), *source_.coarse.coordinates,
                          source_.coarse_between);
    const auto parents = source_.P.getLocalMatrixHost();
    for (std::size_t i = 0; i < is_fitted_.size(); ++i) {
      if (!is_fitted_[i]) continue;
      const auto row = parents.rowConst(static_cast<int>(i));
      Vec3 sum{};
      double squares = 0.0;
      for (int k = 0; k < row.length; ++k) {
        const Vec3 d = columns[row.colidx(k)].x - places_[i];
        sum += d;
        squares += dot(d, d);
      }
      is_fitted_[i] = dot(sum, sum) > exact * exact * row.length * squares;
    }
  }

  bool is_open(std::size_t i) const {
    return is_fitted_[i] && (!fits_[i] || !fits_[i]->spans_plane());
  }

  const RigidSource& source_;
  std::vector<Vec3> places_;
  std::vector<char> is_fitted_;
  std::vector<std::optional<Fit>> fits_;
};

}  // namespace

RigidInterpolation rigid_interpolation(const RigidSource& source) {
  Fits fits(source);
  fits.fit(*source.second.getCrsGraph());
  // Nodes at edges of a wall may see one line of coarse nodes: those look one node further.
  if (const auto beside = fits.beside_open(); !beside.is_null()) {
    CrsMatrix third(beside->getRowMap(), 0);
    algebra::multiply_graphs(*beside, source.second, third);
    fits.fit(*third.getCrsGraph());
  }
  return fits.result();
}

}  // namespace tunica::multigrid
