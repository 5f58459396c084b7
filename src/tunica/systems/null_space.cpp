#include "tunica/systems/null_space.hpp"

#include <algorithm>
#include <cmath>

#include "tunica/base/formatted.hpp"
#include "tunica/base/reduce.hpp"

namespace tunica::systems {

namespace {

constexpr double nothing = 1e-8;  ///< files of eight digits leave 1e-9

/// |A n| / ||A||n||, squared, of the rows or columns of a block.
struct Share {
  double sum = 0.0, all = 0.0;
  void add(double one, double magnitude) {
    sum += one * one;
    all += magnitude * magnitude;
  }
  /// -1 where the block has no entries for n.
  double ratio(const Comm& comm) const {
    const double of_all = global_sum(comm, all), of_sum = global_sum(comm, sum);
    return of_all > 0.0 ? std::sqrt(of_sum / of_all) : -1.0;
  }
};

/// 1 in the unit of the files for the free unknowns of the mode; scale: diagonal of C or R.
std::vector<double> constant(const ConstantMode& mode, const NodeTable& table,
                             const Preparation& preparation, const OfUnknowns& scale) {
  std::vector<double> n;
  for (std::size_t k = 0; k < scale[mode.field].size(); ++k) {
    const bool is_in = preparation.is_known[mode.field][k] == 0.0 &&
                       (mode.field == 1 || table.component[k] == mode.component);
    n.push_back(is_in ? 1.0 / scale[mode.field][k] : 0.0);
  }
  return n;
}

/// Of K n: the largest of its two blocks, so that a small C is not taken for none. 1 for none.
double right_share(const Blocks& blocks, int field, const std::vector<double>& n) {
  double largest = -1.0;
  for (const int i : {0, 1}) {
    const MatrixRows& A = blocks(i, field);
    const Fetched<double> of_column(*A.comm, columns_of(A), n, A.n_columns);
    Share share;
    for (std::size_t row = 0; row < A.n_local_rows(); ++row) {
      double sum = 0.0, all = 0.0;
      for (std::size_t k = A.start[row]; k < A.start[row + 1]; ++k) {
        sum += A.values[k] * of_column(A.columns[k]);
        all += std::abs(A.values[k] * of_column(A.columns[k]));
      }
      share.add(sum, all);
    }
    largest = std::max(largest, share.ratio(*A.comm));
  }
  return largest < 0.0 ? 1.0 : largest;
}

/// Of nᵀ K.
double left_share(const Blocks& blocks, int field, const std::vector<double>& n) {
  double largest = -1.0;
  const auto plus = [](double a, double b) { return a + b; };
  for (const int j : {0, 1}) {
    const MatrixRows& A = blocks(field, j);
    const auto product = [&](std::size_t row, std::size_t k) { return n[row] * A.values[k]; };
    const auto size = [&](std::size_t row, std::size_t k) { return std::abs(product(row, k)); };
    const std::vector<double> sums = over_columns(A, product, plus),
                              all = over_columns(A, size, plus);
    Share share;
    for (std::size_t k = 0; k < sums.size(); ++k) share.add(sums[k], all[k]);
    largest = std::max(largest, share.ratio(*A.comm));
  }
  return largest < 0.0 ? 1.0 : largest;
}

/// b ← b − n (nᵀb)/(nᵀn). |nᵀb| / (|n| |b|) before.
double project(const Comm& comm, const std::vector<double>& n, std::vector<double>& b,
               double size_of_b) {
  double nb = 0.0, nn = 0.0;
  for (std::size_t k = 0; k < n.size(); ++k) {
    nb += n[k] * b[k];
    nn += n[k] * n[k];
  }
  nb = global_sum(comm, nb);
  nn = global_sum(comm, nn);
  for (std::size_t k = 0; k < n.size(); ++k) b[k] -= n[k] * nb / nn;
  return size_of_b > 0.0 ? std::abs(nb) / (std::sqrt(nn) * size_of_b) : 0.0;
}

double norm_of_b(const Blocks& blocks) {
  double sum = 0.0;
  for (const auto& part : blocks.b)
    for (const double value : part) sum += value * value;
  return std::sqrt(global_sum(blocks.comm(), sum));
}

/// σ at the first unknown of the mode, on the rank that has it.
void hold(Blocks& blocks, const ConstantMode& mode, const std::vector<double>& n) {
  MatrixRows& A = blocks(mode.field, mode.field);
  const auto here = std::find_if(n.begin(), n.end(), [](double value) { return value != 0.0; });
  const auto row = static_cast<std::size_t>(here - n.begin());
  const long long number = A.first_row() + static_cast<long long>(row);
  const double mine = here == n.end() ? -1e300 : -static_cast<double>(number);
  if (global_max(*A.comm, mine) > mine || here == n.end()) return;
  for (std::size_t k = A.start[row]; k < A.start[row + 1]; ++k)
    if (A.columns[k] == number) A.values[k] += mode.field == 1 ? -1.0 : A.values[k];
}

std::string name_of(const ConstantMode& mode, int components) {
  if (mode.field == 1) return "constant scalars";
  return components == 1 ? "constants"
                         : formatted("constant vectors of component %d", mode.component);
}

}  // namespace

std::vector<ConstantMode> hold_constants(Blocks& blocks, const NodeTable& table,
                                         Preparation& preparation) {
  const Comm& comm = blocks.comm();
  std::vector<ConstantMode> modes;
  if (blocks.n_rows(1) > 0) modes.push_back({1, 0});
  for (int c = 0; c < table.components; ++c) modes.push_back({0, c});
  std::vector<ConstantMode> found;
  for (const ConstantMode& mode : modes) {
    const std::vector<double> n = constant(mode, table, preparation, preparation.scale);
    const double share = right_share(blocks, mode.field, n);
    if (share > nothing) continue;
    preparation.notes.push_back(
        "K has " + name_of(mode, table.components) + " in its null space " +
        formatted("(|K 1| = %.0e): the solution of zero mean is taken", share));
    const std::vector<double> left = constant(mode, table, preparation, preparation.row_scale);
    if (left_share(blocks, mode.field, left) <= nothing) {
      const double part = project(comm, left, blocks.b[mode.field], norm_of_b(blocks));
      if (part > nothing)
        preparation.remarks.push_back(
            formatted(
                "a part of %.1e of what remains of the right-hand side lies in the null space of ",
                part) +
            name_of(mode, table.components) + ": no solution gives it, and it is left out");
    }
    hold(blocks, mode, n);
    found.push_back(mode);
  }
  return found;
}

}  // namespace tunica::systems
