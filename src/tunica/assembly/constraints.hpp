#pragma once
#include <cstdint>
#include <vector>

#include "tunica/base/tensor.hpp"

namespace tunica::assembly {

/// Prescribed unknowns of a field at each of its nodes. Increments y of the vector unknown have y =
/// P y, where P leaves out components and, on planes that lie across the axes, directions: P = I −
/// Σ_k n_k n_kᵀ with orthonormal n_k. The scalar is prescribed, or not.
class Constraints {
public:
  explicit Constraints(int n_nodes) : bits_(n_nodes, 0) {}

  void fix_component(int node, int i);
  void fix_vector(int node);
  void fix_scalar(int node) { bits_[node] |= scalar_bit; }
  /// Prescribes the vector along n, of length 1, along an axis or oblique. A direction within a
  /// degree of those already prescribed adds nothing.
  void fix_direction(int node, const Vec3& n);
  /// P of the node becomes this one, and the scalar free.
  void replace(int node, const Mat3& P);
  void free_scalars();

  bool is_free(int node) const { return bits_[node] == 0; }
  /// True where all of the component is left out.
  bool is_fixed(int node, int component) const { return (bits_[node] >> component) & 1; }
  bool is_scalar_fixed(int node) const { return (bits_[node] & scalar_bit) != 0; }
  /// P where it leaves out directions across the axes, else null: components say all.
  const Mat3* oblique(int node) const {
    return (bits_[node] & oblique_bit) != 0 ? &oblique_[number_[node]] : nullptr;
  }
  Mat3 projector(int node) const;
  /// P v.
  Vec3 project(int node, const Vec3& v) const;

private:
  static constexpr std::uint8_t scalar_bit = 8, oblique_bit = 16;

  std::vector<std::uint8_t> bits_;  ///< 1, 2, 4: components
  std::vector<int> number_;         ///< per node where any is oblique: of its P
  std::vector<Mat3> oblique_;
};

}  // namespace tunica::assembly
