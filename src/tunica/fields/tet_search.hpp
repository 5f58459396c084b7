#pragma once
#include <array>
#include <vector>

#include "tunica/base/tensor.hpp"

namespace tunica::fields {

/// Finds the tetrahedra in which points lie, or next to which, by a grid of boxes.
class TetSearch {
public:
  /// region: of each tetrahedron. Throws std::invalid_argument where there is none.
  TetSearch(std::vector<Vec3> x, std::vector<std::array<int, 4>> tets, std::vector<int> region);

  /// A value at a point is the sum of those at the vertices of a tetrahedron, each times its
  /// weight.
  struct Spot {
    std::array<int, 4> vertices{};
    std::array<double, 4> weights{};
    double distance = 0.0;  ///< of the point from the tetrahedron, zero within it [mm]
  };
  /// The nearest place in a tetrahedron of that region, or of any with region -1.
  Spot find(const Vec3& point, int region = -1) const;

private:
  using Cell = std::array<int, 3>;

  Cell cell_of(const Vec3& point) const;
  int index_of(const Cell& cell) const { return (cell[2] * n_[1] + cell[1]) * n_[0] + cell[0]; }
  std::array<Vec3, 4> corners(int tet) const;
  void look_in(int box, const Vec3& point, int region, Spot& best) const;
  /// Calls visit with the index of each box that lies so many boxes away from one.
  template <class Visit>
  void visit_ring(const Cell& centre, int ring, const Visit& visit) const;

  std::vector<Vec3> x_;
  std::vector<std::array<int, 4>> tets_;
  std::vector<int> region_;
  Vec3 low_{};
  double size_ = 1.0;  ///< of a box [mm]
  Cell n_{1, 1, 1};
  std::vector<int> first_, in_box_;  ///< tetrahedra of each box
};

}  // namespace tunica::fields
