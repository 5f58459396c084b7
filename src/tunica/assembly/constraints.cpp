#include "tunica/assembly/constraints.hpp"

#include <algorithm>
#include <cmath>

namespace tunica::assembly {

namespace {

constexpr double round_off = 1e-10;
constexpr double same_direction = 0.02;  // what is left of one that is known to a degree

}  // namespace

// P ← P − e_i e_iᵀ
void Constraints::fix_component(int node, int i) {
  Vec3 e{};
  e[i] = 1.0;
  fix_direction(node, e);
}

void Constraints::fix_vector(int node) {
  for (int i = 0; i < 3; ++i) fix_component(node, i);
}

// P ← P − m mᵀ, m the part of n that was free.
void Constraints::fix_direction(int node, const Vec3& n) {
  Mat3 P = projector(node);
  Vec3 m = P * n;
  const double length = norm(m);
  if (length < same_direction) return;
  m = 1.0 / length * m;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) P[i][j] -= m[i] * m[j];
  // replace() makes the scalar free.
  const bool has_fixed_scalar = is_scalar_fixed(node);
  replace(node, P);
  if (has_fixed_scalar) fix_scalar(node);
}

// A projector with zeros and ones on its diagonal is one of components: bits say all. Only another
// one is stored.
void Constraints::replace(int node, const Mat3& P) {
  bits_[node] = 0;
  bool is_oblique = false;
  for (int i = 0; i < 3; ++i) {
    if (P[i][i] < round_off) bits_[node] |= std::uint8_t(1U << i);
    is_oblique = is_oblique || (P[i][i] > round_off && P[i][i] < 1.0 - round_off);
  }
  if (!is_oblique) return;
  bits_[node] |= oblique_bit;
  if (number_.empty()) number_.assign(bits_.size(), -1);
  if (number_[node] < 0) {
    number_[node] = static_cast<int>(oblique_.size());
    oblique_.emplace_back();
  }
  oblique_[number_[node]] = P;
}

void Constraints::free_scalars() {
  for (std::uint8_t& bits : bits_) bits &= std::uint8_t(~scalar_bit);
}

Mat3 Constraints::projector(int node) const {
  if (const Mat3* const P = oblique(node)) return *P;
  Mat3 P{};
  for (int i = 0; i < 3; ++i) P[i][i] = is_fixed(node, i) ? 0.0 : 1.0;
  return P;
}

Vec3 Constraints::project(int node, const Vec3& v) const {
  if (const Mat3* const P = oblique(node)) return *P * v;
  return {is_fixed(node, 0) ? 0.0 : v[0], is_fixed(node, 1) ? 0.0 : v[1],
          is_fixed(node, 2) ? 0.0 : v[2]};
}

}  // namespace tunica::assembly
