#pragma once
#include "tunica/linear/krylov.hpp"
#include "tunica/linear/linear_solver.hpp"
#include "tunica/linear/refresh_rule.hpp"
#include "tunica/linear/solvers/augmented_system.hpp"

namespace tunica::linear {

/// Solves by a Krylov method with one preconditioner, which is kept from matrix to matrix as
/// RefreshRule says.
class KrylovSolver final : public LinearSolver {
public:
  KrylovSolver(const Teuchos::ParameterList& options, const algebra::BlockMatrix& K,
               const NamedOperators& operators);

  /// How solves are given up from now on.
  void give_up_by(const StagnationRule& rule) { *stagnation_ = rule; }
  /// Estimated bytes of the factors that a direct preconditioner will make; 0 for others.
  /// Collective.
  double expected_bytes() const { return system_->expected_bytes(); }

  void matrix_changed() override { is_stale_ = true; }
  void prepare() override;
  void forget() override;
  std::vector<double> save() const override { return system_->save(); }
  void restore(const std::vector<double>& numbers) override { system_->restore(numbers); }
  std::vector<algebra::BlockVector> save_vectors() const override;
  void restore_vectors(const std::vector<algebra::BlockVector>& vectors) override;
  SolveReport solve(const algebra::BlockVector& b, algebra::BlockVector& x,
                    double tolerance) override;

private:
  void refresh_matrix();
  void refresh(SolveReport& report);
  /// z ≈ A⁻¹ w of the blocks, from the z that is there.
  void solve_blocks(const Vector& w, Vector& z);
  /// Iterations of one attempt.
  int iterate(SolveReport& report, bool may_wait);
  void refine(KrylovOptions options, const Teuchos::RCP<const Operator>& K, SolveReport& report);
  bool recycles() const { return !options_.recycled.is_null(); }
  Teuchos::RCP<const Operator> preconditioner() const {
    return augmented_.inverse(system_->preconditioner());
  }

  algebra::BlockSpacePtr space_;
  std::string preconditioner_;
  KrylovOptions options_;
  Teuchos::RCP<StagnationRule> stagnation_ = Teuchos::rcp(new StagnationRule);
  RefreshRule rule_;
  std::unique_ptr<PreconditionedSystem> system_;
  AugmentedSystem augmented_;
  MultiVector b_, x_;
  bool is_stale_ = true;
  bool is_behind_ = false;  ///< the preconditioner is that of an earlier matrix
};

}  // namespace tunica::linear
