#pragma once
#include "tunica/algebra/merged_matrix.hpp"
#include "tunica/linear/direct/direct_factor.hpp"
#include "tunica/linear/linear_solver.hpp"
#include "tunica/linear/solvers/augmented_system.hpp"

namespace tunica::linear {

/// Solves by sparse LU factors of each matrix.
class DirectSolver final : public LinearSolver {
public:
  /// most_operations: as those of DirectFactor.
  explicit DirectSolver(const algebra::BlockMatrix& K, double most_operations = 0.0);

  void matrix_changed() override { is_stale_ = true; }
  void prepare() override;
  void forget() override {}  // a matrix's own factors are all that there is
  SolveReport solve(const algebra::BlockVector& b, algebra::BlockVector& x,
                    double tolerance) override;

private:
  /// Solves with all of K, whose matrix-free parts are not in the factors. Returns iterations.
  int solve_whole(double tolerance);
  void solve_sum();

  algebra::MergedMatrix K_;
  DirectFactor factor_;
  AugmentedSystem augmented_;
  Vector b_, x_;
  bool is_stale_ = true;
};

}  // namespace tunica::linear
