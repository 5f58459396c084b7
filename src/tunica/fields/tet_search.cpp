#include "tunica/fields/tet_search.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "tunica/fields/simplex.hpp"

namespace tunica::fields {

namespace {

struct Box {
  Vec3 low{1e300, 1e300, 1e300}, high{-1e300, -1e300, -1e300};

  void add(const Vec3& x) {
    for (int i = 0; i < 3; ++i) {
      low[i] = std::min(low[i], x[i]);
      high[i] = std::max(high[i], x[i]);
    }
  }
};

/// Of which there are about as many as tetrahedra.
double box_size(const Box& all, std::size_t n_tets) {
  const Vec3 extent = all.high - all.low;
  const double longest = std::max({extent[0], extent[1], extent[2]});
  double volume = 1.0;
  for (int i = 0; i < 3; ++i) volume *= std::max(extent[i], 1e-3 * longest);
  return std::cbrt(volume / static_cast<double>(n_tets));
}

}  // namespace

TetSearch::TetSearch(std::vector<Vec3> x, std::vector<std::array<int, 4>> tets,
                     std::vector<int> region)
    : x_(std::move(x)), tets_(std::move(tets)), region_(std::move(region)) {
  if (tets_.empty()) throw std::invalid_argument("a search needs tetrahedra");
  Box all;
  for (const Vec3& point : x_) all.add(point);
  low_ = all.low;
  size_ = box_size(all, tets_.size());
  for (int i = 0; i < 3; ++i) n_[i] = 1 + static_cast<int>((all.high[i] - all.low[i]) / size_);
  // Counted, then filled: the boxes of a tetrahedron are those that its own box touches.
  const auto visit = [this](int tet, const auto& take) {
    Box box;
    for (const Vec3& corner : corners(tet)) box.add(corner);
    const Cell from = cell_of(box.low), to = cell_of(box.high);
    for (int k = from[2]; k <= to[2]; ++k)
      for (int j = from[1]; j <= to[1]; ++j)
        for (int i = from[0]; i <= to[0]; ++i) take(index_of({i, j, k}));
  };
  const int n_tets = static_cast<int>(tets_.size());
  first_.assign(static_cast<std::size_t>(n_[0]) * n_[1] * n_[2] + 1, 0);
  for (int tet = 0; tet < n_tets; ++tet) visit(tet, [this](int box) { ++first_[box + 1]; });
  for (std::size_t box = 1; box < first_.size(); ++box) first_[box] += first_[box - 1];
  in_box_.resize(first_.back());
  std::vector<int> next(first_.begin(), first_.end() - 1);
  for (int tet = 0; tet < n_tets; ++tet) visit(tet, [&](int box) { in_box_[next[box]++] = tet; });
}

TetSearch::Cell TetSearch::cell_of(const Vec3& point) const {
  Cell cell;
  for (int i = 0; i < 3; ++i)
    cell[i] = static_cast<int>(
        std::clamp((point[i] - low_[i]) / size_, 0.0, static_cast<double>(n_[i] - 1)));
  return cell;
}

std::array<Vec3, 4> TetSearch::corners(int tet) const {
  std::array<Vec3, 4> x;
  for (int a = 0; a < 4; ++a) x[a] = x_[tets_[tet][a]];
  return x;
}

void TetSearch::look_in(int box, const Vec3& point, int region, Spot& best) const {
  for (int k = first_[box]; k < first_[box + 1]; ++k) {
    const int tet = in_box_[k];
    if (region >= 0 && region_[tet] != region) continue;
    const std::array<Vec3, 4> x = corners(tet);
    const std::array<double, 4> weights = weights_in(x, point);
    if (is_inside(weights)) {
      best = {tets_[tet], weights, 0.0};
      return;
    }
    const std::array<double, 4> nearest = nearest_in(x, point);
    const double distance = norm(point - point_of(nearest, x));
    if (distance < best.distance) best = {tets_[tet], nearest, distance};
  }
}

template <class Visit>
void TetSearch::visit_ring(const Cell& centre, int ring, const Visit& visit) const {
  Cell from, to;
  for (int i = 0; i < 3; ++i) {
    from[i] = std::max(centre[i] - ring, 0);
    to[i] = std::min(centre[i] + ring, n_[i] - 1);
  }
  for (int k = from[2]; k <= to[2]; ++k)
    for (int j = from[1]; j <= to[1]; ++j) {
      const bool is_side = std::abs(k - centre[2]) == ring || std::abs(j - centre[1]) == ring;
      // Within, only the two ends of a row are that far away.
      for (int i = from[0]; i <= to[0]; ++i)
        if (is_side || std::abs(i - centre[0]) == ring) visit(index_of({i, j, k}));
    }
}

// What lies in the boxes of ring r + 1 is farther from the point than r boxes, also where the point
// lies out of all boxes: the box nearest to it takes its place.
TetSearch::Spot TetSearch::find(const Vec3& point, int region) const {
  const Cell centre = cell_of(point);
  const int most = std::max({n_[0], n_[1], n_[2]});
  Spot best;
  best.distance = 1e300;
  for (int ring = 0; ring <= most && best.distance > (ring - 1) * size_; ++ring)
    visit_ring(centre, ring, [&](int box) {
      if (best.distance > 0.0) look_in(box, point, region, best);
    });
  return best;
}

}  // namespace tunica::fields
