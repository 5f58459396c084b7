#include "tunica/smoothers/node_ilu/node_ilu_sweeps.hpp"

#include <type_traits>

#include "tunica/base/clones.hpp"

namespace tunica::smoothers {

namespace {

// All of it is inlined, so that each function for certain processors has its own.

/// Four numbers in a register.
template <class Real>
struct Registers;
template <>
struct Registers<float> {
  using Four = float __attribute__((vector_size(16)));
};
template <>
struct Registers<double> {
  using Four = double __attribute__((vector_size(32)));
};

template <class Real>
using Four = typename Registers<Real>::Four;

template <class Real>
[[gnu::always_inline]] inline void load(const Real* from, Four<Real>& to) {
  std::memcpy(&to, from, sizeof(to));
}
/// Number by number, of which compilers make one instruction; of __builtin_convertvector they make
/// four.
[[gnu::always_inline]] inline void as_doubles(const Four<float>& from, Four<double>& to) {
  to = Four<double>{from[0], from[1], from[2], from[3]};
}
[[gnu::always_inline]] inline void as_doubles(const Four<double>& from, Four<double>& to) {
  to = from;
}
/// Columns of four numbers, one after the other.
template <int columns, class Real>
[[gnu::always_inline]] inline void load_columns(const Real* from, Four<Real> (&to)[columns]) {
  for (int c = 0; c < columns; ++c) load(from + 4 * c, to[c]);
}
template <int columns>
[[gnu::always_inline]] inline void load_columns(const float* from, Four<double> (&to)[columns]) {
  for (int c = 0; c < columns; ++c) {
    Four<float> column;
    load(from + 4 * c, column);
    as_doubles(column, to[c]);
  }
}
/// Two columns at a time: zeros that are put in between make floats of halves.
template <int columns>
[[gnu::always_inline]] inline void load_columns(const Half* from, Four<float> (&to)[columns]) {
  using Eight = std::uint16_t __attribute__((vector_size(16)));
  const Eight zeros{};
  for (int c = 0; c < columns; c += 2) {
    Eight halves{};
    std::memcpy(&halves, from + 4 * c, c + 1 < columns ? 16 : 8);
    const Eight first = __builtin_shufflevector(zeros, halves, 0, 8, 1, 9, 2, 10, 3, 11);
    std::memcpy(&to[c], &first, sizeof(first));
    if (c + 1 == columns) return;
    const Eight second = __builtin_shufflevector(zeros, halves, 4, 12, 5, 13, 6, 14, 7, 15);
    std::memcpy(&to[c + 1], &second, sizeof(second));
  }
}

[[gnu::always_inline]] inline double one(const double* from) { return *from; }
[[gnu::always_inline]] inline float one(const float* from) { return *from; }
[[gnu::always_inline]] inline float one(const Half* from) { return widened(*from); }

/// The y of one row of blocks: y −= M x for one of its blocks after the other.
template <int width, int rows, class Real>
struct RowSum {
  Real y[rows];

  [[gnu::always_inline]] void begin(const Real* from) {
    for (int i = 0; i < rows; ++i) y[i] = from[i];
  }
  template <int columns, class Stored>
  [[gnu::always_inline]] void subtract(const Stored* M, const Real* x) {
    for (int c = 0; c < columns; ++c)
      for (int i = 0; i < rows; ++i) y[i] -= one(M + rows * c + i) * x[c];
  }
  [[gnu::always_inline]] void end(Real* to) const {
    for (int i = 0; i < rows; ++i) to[i] = y[i];
  }
};

/// Four rows: a sum for each column, so that no step has to wait for the one before.
template <class Real>
struct RowSum<4, 4, Real> {
  Four<Real> y[4];

  [[gnu::always_inline]] void begin(const Real* from) {
    load(from, y[0]);
    for (int c = 1; c < 4; ++c) y[c] = Four<Real>{};
  }
  template <int columns, class Stored>
  [[gnu::always_inline]] void subtract(const Stored* M, const Real* x) {
    Four<Real> block[columns];
    load_columns(M, block);
    for (int c = 0; c < columns; ++c) y[c] -= block[c] * x[c];
  }
  [[gnu::always_inline]] void end(Real* to) const {
    const Four<Real> sum = (y[0] + y[1]) + (y[2] + y[3]);
    std::memcpy(to, &sum, sizeof(sum));
  }
};

/// Bytes. Blocks are asked for so far ahead of their use: from memory that other programs use, too,
/// solves took 3.9 ms for 5.7 and products 6.6 for 7.5 (factors and matrix of 30 and 60 MB).
constexpr int ahead = 4096;

/// y_i = b_i − Σ_k M_ik x_k for the blocks of a row from and up to these columns. Returns where the
/// next row's blocks are.
template <int width, int rows, class Stored, class Real>
[[gnu::always_inline]] inline const Stored* subtract_row(const BlockPattern& pattern,
                                                         std::size_t first, std::size_t last,
                                                         const Stored* M, const Real* x,
                                                         const Real* b_i, Real* y_i) {
  RowSum<width, rows, Real> sum;
  sum.begin(b_i);
  for (std::size_t k = first; k < last; ++k) {
    const int node = pattern.columns[k];
    __builtin_prefetch(reinterpret_cast<const char*>(M) + ahead);
    const Real* const x_k = x + static_cast<std::size_t>(width) * node;
    // Widths are constants of the compiler: blocks of 4, 3 or 2, or the scalar alone.
    if (pattern.unknowns[node] == width) {
      sum.template subtract<width>(M, x_k);
      M += rows * width;
    } else {
      sum.template subtract<1>(M, x_k + width - 1);
      M += rows;
    }
  }
  sum.end(y_i);
  return M;
}

/// Blocks of a row of the pattern.
struct RowPart {
  std::size_t first, last;
};

/// The same for a row of either kind; b and y have values of all nodes.
template <int width, class Stored, class Real>
[[gnu::always_inline]] inline const Stored* subtract_row(const BlockPattern& pattern, int node,
                                                         RowPart part, const Stored* M,
                                                         const Real* x, const Real* b, Real* y) {
  const auto place = static_cast<std::size_t>(width) * node;
  if (pattern.unknowns[node] == width)
    return subtract_row<width, width>(pattern, part.first, part.last, M, x, b + place, y + place);
  return subtract_row<width, 1>(pattern, part.first, part.last, M, x, b + place + width - 1,
                                y + place + width - 1);
}

/// y ← M y.
template <int width, int rows, class Real>
[[gnu::always_inline]] inline void multiply(const Real* M, Real* y) {
  Real negative[rows], x[rows];
  for (int i = 0; i < rows; ++i) {
    negative[i] = Real(0);
    x[i] = y[i];
  }
  RowSum<width, rows, Real> sum;
  sum.begin(negative);
  sum.template subtract<rows>(M, x);
  sum.end(negative);
  for (int i = 0; i < rows; ++i) y[i] = -negative[i];
}

template <int width, class Stored, class Real>
[[gnu::always_inline]] inline void solve(const NodeFactors<Stored, Real>& f, Real* x) {
  const BlockPattern& pattern = f.pattern;
  // y_i = x_i − Σ_k<i L_ik y_k
  const Stored* lower = f.lower;
  for (int node = 0; node < pattern.n_nodes; ++node)
    lower =
        subtract_row<width>(pattern, node, {pattern.start[node], f.diagonal[node]}, lower, x, x, x);
  // x_i = D_i⁻¹ (y_i − Σ_k>i U_ik x_k)
  const Stored* upper = f.upper;
  for (int node = pattern.n_nodes - 1; node >= 0; --node) {
    upper = subtract_row<width>(pattern, node, {f.diagonal[node] + 1, pattern.start[node + 1]},
                                upper, x, x, x);
    const Real* const inverse = f.inverses + static_cast<std::size_t>(width) * width * node;
    Real* const x_i = x + static_cast<std::size_t>(width) * node;
    if (pattern.unknowns[node] == width)
      multiply<width, width>(inverse, x_i);
    else
      x_i[width - 1] *= *inverse;
  }
}

template <class Stored, class Real>
[[gnu::always_inline]] inline void solve_any(const NodeFactors<Stored, Real>& f, Real* x) {
  if (f.pattern.width == 4) return solve<4>(f, x);
  if (f.pattern.width == 3) return solve<3>(f, x);
  solve<2>(f, x);
}

template <int width, class Real>
[[gnu::always_inline]] inline void find_rows(const NodeMatrix<Real>& K, const double* b,
                                             const double* x, double* r) {
  const Real* values = K.values;
  for (int node = 0; node < K.pattern.n_nodes; ++node)
    values = subtract_row<width>(
        K.pattern, node, {K.pattern.start[node], K.pattern.start[node + 1]}, values, x, b, r);
}

template <class Real>
[[gnu::always_inline]] inline void find_any(const NodeMatrix<Real>& K, const double* b,
                                            const double* x, double* r) {
  if (K.pattern.width == 4) return find_rows<4>(K, b, x, r);
  if (K.pattern.width == 3) return find_rows<3>(K, b, x, r);
  find_rows<2>(K, b, x, r);
}

template <int width>
[[gnu::always_inline]] inline void subtract_blocks(const double* A, const double* B, double* C) {
  for (int c = 0; c < width; ++c) {
    RowSum<width, width, double> sum;
    sum.begin(C + width * c);
    sum.template subtract<width>(A, B + width * c);
    sum.end(C + width * c);
  }
}

template <class Stored>
[[gnu::always_inline]] inline void subtract_whole_block(const double* F, const Stored* B,
                                                        double* C) {
  std::conditional_t<std::is_same_v<Stored, double>, Four<double>, Four<float>> columns[4];
  load_columns(B, columns);
  Four<double> f[4];
  load_columns(F, f);
  for (int c = 0; c < 4; ++c) {
    Four<double> b, C_c;
    as_doubles(columns[c], b);
    load(C + 4 * c, C_c);
    C_c -= (f[0] * b[0] + f[1] * b[1]) + (f[2] * b[2] + f[3] * b[3]);
    std::memcpy(C + 4 * c, &C_c, sizeof(C_c));
  }
}

/// C −= F B for a block B of so many rows and columns, the last ones of C's and F's.
template <int width, int rows, int columns, class Stored>
[[gnu::always_inline]] inline void subtract_block(const double* F, const Stored* B, double* C) {
  if constexpr (rows == 4 && columns == 4) return subtract_whole_block(F, B, C);
  for (int c = 0; c < columns; ++c) {
    double* const C_c = C + width * (width - columns + c);
    for (int r = 0; r < rows; ++r) {
      const double b = one(B + rows * c + r);
      for (int i = 0; i < width; ++i) C_c[i] -= F[width * (width - rows + r) + i] * b;
    }
  }
}

template <int width, class Stored>
[[gnu::always_inline]] inline void subtract_upper_row(const BlockPattern& pattern,
                                                      const UpperRow<Stored>& U, const double* F,
                                                      const int* slots, double* row) {
  const Stored* B = U.values;
  const bool is_whole = pattern.unknowns[U.node] == width;
  for (std::size_t k = U.first; k < U.last; ++k) {
    const int column = pattern.columns[k], slot = slots[column];
    const bool has_whole_column = pattern.unknowns[column] == width;
    if (slot >= 0) {
      double* const C = row + static_cast<std::size_t>(width) * width * slot;
      if (is_whole && has_whole_column)
        subtract_block<width, width, width>(F, B, C);
      else if (is_whole)
        subtract_block<width, width, 1>(F, B, C);
      else if (has_whole_column)
        subtract_block<width, 1, width>(F, B, C);
      else
        subtract_block<width, 1, 1>(F, B, C);
    }
    B += pattern.unknowns[U.node] * pattern.unknowns[column];
  }
}

template <class Stored>
[[gnu::always_inline]] inline void subtract_upper_any(const BlockPattern& pattern,
                                                      const UpperRow<Stored>& U, const double* F,
                                                      const int* slots, double* row) {
  if (pattern.width == 4) return subtract_upper_row<4>(pattern, U, F, slots, row);
  if (pattern.width == 3) return subtract_upper_row<3>(pattern, U, F, slots, row);
  subtract_upper_row<2>(pattern, U, F, slots, row);
}

}  // namespace

TUNICA_CLONES void subtract_upper(const BlockPattern& pattern, const UpperRow<Half>& U,
                                  const double* F, const int* slots, double* row) {
  subtract_upper_any(pattern, U, F, slots, row);
}
TUNICA_CLONES void subtract_upper(const BlockPattern& pattern, const UpperRow<float>& U,
                                  const double* F, const int* slots, double* row) {
  subtract_upper_any(pattern, U, F, slots, row);
}
TUNICA_CLONES void subtract_upper(const BlockPattern& pattern, const UpperRow<double>& U,
                                  const double* F, const int* slots, double* row) {
  subtract_upper_any(pattern, U, F, slots, row);
}

TUNICA_CLONES void solve_factors(const NodeFactors<Half, float>& factors, float* x) {
  solve_any(factors, x);
}
TUNICA_CLONES void solve_factors(const NodeFactors<float, float>& factors, float* x) {
  solve_any(factors, x);
}
TUNICA_CLONES void solve_factors(const NodeFactors<double, double>& factors, double* x) {
  solve_any(factors, x);
}

TUNICA_CLONES void find_residual(const NodeMatrix<float>& K, const double* b, const double* x,
                                 double* r) {
  find_any(K, b, x, r);
}
TUNICA_CLONES void find_residual(const NodeMatrix<double>& K, const double* b, const double* x,
                                 double* r) {
  find_any(K, b, x, r);
}

TUNICA_CLONES void subtract_product(int width, const double* A, const double* B, double* C) {
  if (width == 4) return subtract_blocks<4>(A, B, C);
  if (width == 3) return subtract_blocks<3>(A, B, C);
  subtract_blocks<2>(A, B, C);
}

}  // namespace tunica::smoothers
