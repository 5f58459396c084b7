#include "tunica/multigrid/galerkin/least_stabilisation.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "tunica/algebra/independent_set.hpp"
#include "tunica/base/trilinos.hpp"

namespace tunica::multigrid {

namespace {

/// A level needs 4 times the one before, and less where C outweighs B. What wants much more is no
/// stabilisation, but the rounding of a zero.
constexpr double most = 16.0;

/// Block of each unknown, by local numbers of a map.
std::vector<int> blocks_of(const Map& map, const algebra::DofLayout& numbering) {
  std::vector<int> all;
  for (const GlobalOrdinal number : global_numbers(map)) all.push_back(numbering.block_of(number));
  return all;
}

struct Blocks {
  std::vector<int> of_rows, of_columns;
};

/// f_i of scalars, 1 in rows of vectors and where there is no C. Collective.
Vector factors(const CrsMatrix& K, const Blocks& blocks, double sigma) {
  Vector diagonal(K.getRowMap()), f(K.getRowMap());
  K.getLocalDiagCopy(diagonal);
  const Vector on_columns = algebra::on_columns(K, diagonal);
  const auto D = on_columns.getLocalViewHost(read_only);
  const auto own = diagonal.getLocalViewHost(read_only);
  const auto factor = f.getLocalViewHost(overwrite_all);
  const auto local = K.getLocalMatrixHost();
  for (int i = 0; i < local.numRows(); ++i) {
    factor(i, 0) = 1.0;
    const double c = -own(i, 0);
    if (blocks.of_rows[i] == 0 || !(c > 0.0)) continue;
    double s = 0.0;
    const auto row = local.rowConst(i);
    for (int k = 0; k < row.length; ++k)
      if (const int j = row.colidx(k); blocks.of_columns[j] == 0 && D(j, 0) != 0.0)
        s += row.value(k) * row.value(k) / std::abs(D(j, 0));
    factor(i, 0) = std::clamp(sigma * s / c, 1.0, most);
  }
  return f;
}

}  // namespace

void enlarge_stabilisation(CrsMatrix& K, const algebra::DofLayout& numbering, double sigma) {
  const Blocks blocks{blocks_of(*K.getRowMap(), numbering), blocks_of(*K.getColMap(), numbering)};
  const Vector f = factors(K, blocks, sigma);
  if (!(f.normInf() > 1.0)) return;
  const Vector on_columns = algebra::on_columns(K, f);
  const auto domain = K.getDomainMap(), range = K.getRangeMap();
  K.resumeFill();
  {
    const auto local = K.getLocalMatrixHost();
    const auto f_i = f.getLocalViewHost(read_only), f_j = on_columns.getLocalViewHost(read_only);
    for (int i = 0; i < local.numRows(); ++i) {
      if (blocks.of_rows[i] == 0) continue;
      const int own = K.getColMap()->getLocalElement(K.getRowMap()->getGlobalElement(i));
      double more = 0.0, *diagonal = nullptr;
      auto row = local.row(i);
      for (int k = 0; k < row.length; ++k) {
        const int j = row.colidx(k);
        if (j == own) diagonal = &row.value(k);
        // C_ij < 0, stored as −C_ij
        if (j == own || blocks.of_columns[j] != blocks.of_rows[i] || !(row.value(k) > 0.0))
          continue;
        const double added = (0.5 * (f_i(i, 0) + f_j(j, 0)) - 1.0) * row.value(k);
        row.value(k) += added;
        more += added;
      }
      if (diagonal != nullptr) *diagonal -= more;
    }
  }
  K.fillComplete(domain, range);
}

}  // namespace tunica::multigrid
