#pragma once
#include <Teuchos_LAPACK.hpp>
#include <algorithm>

#include "tunica/base/trilinos.hpp"
#include "unit/smoothers/wall_matrix.hpp"

namespace tunica::test {

/// Solves M y = r by LAPACK, M row by row.
inline std::vector<double> solve_dense(const std::vector<double>& M, std::vector<double> r) {
  const int n = static_cast<int>(r.size());
  std::vector<double> by_columns(M.size());
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) by_columns[j * n + i] = M[i * n + j];
  std::vector<int> exchanged(n);
  int info = 0;
  Teuchos::LAPACK<int, double>().GESV(n, 1, by_columns.data(), n, exchanged.data(), r.data(), n,
                                      &info);
  if (info != 0) throw std::runtime_error("LAPACK cannot solve the patch");
  return r;
}

/// Vanka's smoother without any art: full rows, patches found in the blocks, LAPACK for each patch.
class DenseSweep {
public:
  explicit DenseSweep(const WallMatrix& wall)
      : K_(*wall.K()), n_columns_(static_cast<int>(n_local(*K_.getColMap()))) {
    const auto local = K_.getLocalMatrixHost();
    full_.assign(static_cast<std::size_t>(local.numRows()) * n_columns_, 0.0);
    for (int i = 0; i < local.numRows(); ++i) {
      const auto row = local.rowConst(i);
      for (int k = 0; k < row.length; ++k) at(i, row.colidx(k)) = row.value(k);
      column_.push_back(K_.getColMap()->getLocalElement(K_.getRowMap()->getGlobalElement(i)));
    }
    find_patches(wall);
  }

  /// Velocities ascending, the pressure last.
  const std::vector<std::vector<int>>& patches() const { return patches_; }
  const std::vector<int>& uncovered_rows() const { return lone_rows_; }

  /// One sweep of the patches in this order, 0 .. n-1 or any other.
  void relax(const Vector& b, Vector& x, const std::vector<int>& order, double damping) const {
    std::vector<double> all = own_and_ghosts(x);
    const auto rhs = b.getLocalViewHost(read_only);
    relax_lone_rows(rhs.data(), all);
    for (const int patch : order) {
      const auto moves = solution(patch, rhs.data(), all);
      for (std::size_t a = 0; a < moves.size(); ++a)
        all[column_[patches_[patch][a]]] += damping * moves[a];
    }
    take_own(all, x);
  }

  /// All patches at once; each row moves by the mean of what its patches want.
  void relax_at_once(const Vector& b, Vector& x, double damping) const {
    std::vector<double> all = own_and_ghosts(x), sums(column_.size(), 0.0);
    std::vector<int> counts(column_.size(), 0);
    const auto rhs = b.getLocalViewHost(read_only);
    relax_lone_rows(rhs.data(), all);
    for (std::size_t p = 0; p < patches_.size(); ++p) {
      const auto moves = solution(static_cast<int>(p), rhs.data(), all);
      for (std::size_t a = 0; a < moves.size(); ++a) {
        sums[patches_[p][a]] += moves[a];
        ++counts[patches_[p][a]];
      }
    }
    for (std::size_t i = 0; i < sums.size(); ++i)
      if (counts[i] > 0) all[column_[i]] += damping * sums[i] / counts[i];
    take_own(all, x);
  }

private:
  double& at(int row, int column) {
    return full_[static_cast<std::size_t>(row) * n_columns_ + column];
  }
  double at(int row, int column) const {
    return full_[static_cast<std::size_t>(row) * n_columns_ + column];
  }

  void find_patches(const WallMatrix& wall) {
    const fields::NodeGraph graph = fields::make_node_graph(wall.mesh());
    const auto B2 = wall.jacobian.K(1, 0)->getLocalMatrixHost().values;
    std::vector<char> is_covered(column_.size(), 0);
    for (int a = 0; a < wall.mesh().n_owned; ++a) {
      std::vector<int> rows;
      for (std::size_t k = graph.row_start[a]; k < graph.row_start[a + 1]; ++k)
        for (int i = 0; i < 3; ++i)
          if (graph.columns[k] < wall.mesh().n_owned && B2(3 * k + i) != 0.0)
            rows.push_back(4 * graph.columns[k] + i);
      std::sort(rows.begin(), rows.end());
      rows.push_back(4 * a + 3);
      for (const int row : rows) is_covered[row] = 1;
      patches_.push_back(rows);
    }
    for (std::size_t i = 0; i < is_covered.size(); ++i)
      if (!is_covered[i]) lone_rows_.push_back(static_cast<int>(i));
  }

  std::vector<double> own_and_ghosts(const Vector& x) const {
    Vector all(K_.getColMap());
    const auto importer = K_.getGraph()->getImporter();
    if (importer.is_null())
      all.assign(x);
    else
      all.doImport(x, *importer, insert);
    const auto values = all.getData();
    return {values.begin(), values.end()};
  }

  void take_own(const std::vector<double>& all, Vector& x) const {
    for (std::size_t i = 0; i < column_.size(); ++i)
      x.replaceLocalValue(static_cast<int>(i), all[column_[i]]);
  }

  double residual(int row, const double* b, const std::vector<double>& x) const {
    double r = b[row];
    for (int c = 0; c < n_columns_; ++c) r -= at(row, c) * x[c];
    return r;
  }

  void relax_lone_rows(const double* b, std::vector<double>& x) const {
    for (const int row : lone_rows_) x[column_[row]] += residual(row, b, x) / at(row, column_[row]);
  }

  std::vector<double> solution(int patch, const double* b, const std::vector<double>& x) const {
    std::vector<double> M, r;
    for (const int i : patches_[patch]) {
      r.push_back(residual(i, b, x));
      for (const int j : patches_[patch]) M.push_back(at(i, column_[j]));
    }
    return solve_dense(M, r);
  }

  const CrsMatrix& K_;
  int n_columns_;
  std::vector<double> full_;
  std::vector<int> column_;  ///< of each row
  std::vector<std::vector<int>> patches_;
  std::vector<int> lone_rows_;
};

}  // namespace tunica::test
