#pragma once
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "tunica/base/clones.hpp"

/// TUNICA_CLONES for work on packs: all that such a function calls becomes part of it, so that each
/// of its two makes is of one kind throughout.
#define TUNICA_PACKED TUNICA_CLONES __attribute__((flatten))

namespace tunica {

/// Four numbers at once: a kernel that is written for any kind of number works on four elements
/// with it, one in each lane. Where the processor has no such registers the compiler takes more
/// instructions.
///
/// Its copy constructor is not trivial, so that functions of either make hand it over in memory
/// wherever one of them is not part of the other.
class Pack {
public:
  static constexpr int size = 4;
  using Values = double __attribute__((vector_size(size * sizeof(double))));

  /// To and from four doubles in a row.
  static Pack load(const double* from) {
    Values v;
    std::memcpy(&v, from, sizeof(v));
    return v;
  }
  void store(double* to) const { std::memcpy(to, &v_, sizeof(v_)); }

  Pack() = default;  // Pack{} is zero, as double{} is
  Pack(double value) : v_{value, value, value, value} {}
  Pack(const Values& values) : v_(values) {}
  Pack(const Pack& other) : v_(other.v_) {}
  Pack& operator=(const Pack& other) {
    v_ = other.v_;
    return *this;
  }

  double operator[](int lane) const { return v_[lane]; }
  void set(int lane, double value) { v_[lane] = value; }
  const Values& values() const { return v_; }

  Pack& operator+=(const Pack& b) { return *this = v_ + b.v_; }
  Pack& operator-=(const Pack& b) { return *this = v_ - b.v_; }
  Pack& operator*=(const Pack& b) { return *this = v_ * b.v_; }

  friend Pack operator-(const Pack& a) { return -a.v_; }
  friend Pack operator+(const Pack& a, const Pack& b) { return a.v_ + b.v_; }
  friend Pack operator-(const Pack& a, const Pack& b) { return a.v_ - b.v_; }
  friend Pack operator*(const Pack& a, const Pack& b) { return a.v_ * b.v_; }
  friend Pack operator/(const Pack& a, const Pack& b) { return a.v_ / b.v_; }

  /// Cube roots of positive numbers, all lanes at once, which std::cbrt does not offer. A third of
  /// the exponent is within 4 %, and a step of Halley's method leaves two thirds of the cube of an
  /// error.
  friend Pack cbrt(const Pack& a) {
    Pack y{third_of_exponent(a[0]), third_of_exponent(a[1]), third_of_exponent(a[2]),
           third_of_exponent(a[3])};
    for (int step = 0; step < 3; ++step) {
      const Pack cube = y * y * y;
      y += y * ((a - cube) / (2.0 * cube + a));
    }
    return y;
  }
  friend Pack exp(const Pack& a) {
    return {std::exp(a[0]), std::exp(a[1]), std::exp(a[2]), std::exp(a[3])};
  }

private:
  Pack(double a, double b, double c, double d) : v_{a, b, c, d} {}

  /// The number of a third of the bits of a, in which the exponent stands before the digits: what
  /// the exponent of 1 lacks then is added, a little less for the least error over all digits.
  static double third_of_exponent(double a) {
    constexpr std::uint64_t rest_of_one = 0x2A9F7893782DA1CE;
    std::uint64_t bits;
    std::memcpy(&bits, &a, sizeof(bits));
    bits = bits / 3 + rest_of_one;
    std::memcpy(&a, &bits, sizeof(bits));
    return a;
  }

  Values v_;
};

// What numbers and packs share: a kernel is written with these for both.

/// yes where a > b, else no.
inline double where_greater(double a, double b, double yes, double no) { return a > b ? yes : no; }
inline Pack where_greater(const Pack& a, const Pack& b, const Pack& yes, const Pack& no) {
  return a.values() > b.values() ? yes.values() : no.values();
}
inline bool any_greater(double a, double b) { return a > b; }
inline bool any_greater(const Pack& a, const Pack& b) {
  bool is_any = false;
  for (int lane = 0; lane < Pack::size; ++lane) is_any |= a[lane] > b[lane];
  return is_any;
}
inline bool all_greater(double a, double b) { return a > b; }
inline bool all_greater(const Pack& a, const Pack& b) {
  bool are_all = true;
  for (int lane = 0; lane < Pack::size; ++lane) are_all &= a[lane] > b[lane];
  return are_all;
}

// One element's numbers into a lane and out of it, of tensors as of numbers.
inline void set_lane(Pack& to, int lane, double from) { to.set(lane, from); }
template <class Packs, class Numbers, std::size_t n>
void set_lane(std::array<Packs, n>& to, int lane, const std::array<Numbers, n>& from) {
  for (std::size_t i = 0; i < n; ++i) set_lane(to[i], lane, from[i]);
}
inline double lane_of(const Pack& from, int lane) { return from[lane]; }
template <std::size_t n>
std::array<double, n> lane_of(const std::array<Pack, n>& from, int lane) {
  std::array<double, n> to;
  for (std::size_t i = 0; i < n; ++i) to[i] = from[i][lane];
  return to;
}
template <std::size_t n, std::size_t m>
std::array<std::array<double, m>, n> lane_of(const std::array<std::array<Pack, m>, n>& from,
                                             int lane) {
  std::array<std::array<double, m>, n> to;
  for (std::size_t i = 0; i < n; ++i) to[i] = lane_of(from[i], lane);
  return to;
}

}  // namespace tunica
