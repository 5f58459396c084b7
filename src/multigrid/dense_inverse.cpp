#include "multigrid/dense_inverse.hpp"

#include <cmath>
#include <utility>

namespace tunica::multigrid {

namespace {

int largest_in_column(int n, const double* a, int column) {
  int best = column;
  for (int i = column + 1; i < n; ++i)
    if (std::abs(a[i * n + column]) > std::abs(a[best * n + column])) best = i;
  return best;
}

void swap_rows(int n, double* a, int i, int j) {
  if (i == j) return;
  for (int k = 0; k < n; ++k) std::swap(a[i * n + k], a[j * n + k]);
}

void swap_columns(int n, double* a, int i, int j) {
  if (i == j) return;
  for (int k = 0; k < n; ++k) std::swap(a[k * n + i], a[k * n + j]);
}

}  // namespace

bool invert_dense(int n, double* a, std::vector<int>& exchanged) {
  exchanged.resize(n);
  for (int k = 0; k < n; ++k) {
    const int pivot_row = largest_in_column(n, a, k);
    const double pivot = a[pivot_row * n + k];
    if (!(std::abs(pivot) > 0.0) || !std::isfinite(pivot)) return false;
    exchanged[k] = pivot_row;
    swap_rows(n, a, k, pivot_row);
    double* const row = a + k * n;
    row[k] = 1.0;
    const double inverse = 1.0 / pivot;
    for (int j = 0; j < n; ++j) row[j] *= inverse;
    for (int i = 0; i < n; ++i) {
      if (i == k) continue;
      double* const other = a + i * n;
      const double factor = other[k];
      other[k] = 0.0;
      for (int j = 0; j < n; ++j) other[j] -= factor * row[j];
    }
  }
  for (int k = n - 1; k >= 0; --k) swap_columns(n, a, k, exchanged[k]);
  return true;
}

}  // namespace tunica::multigrid
