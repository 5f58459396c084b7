#pragma once
#include <functional>
#include <set>

#include "tunica/linear/solvers/krylov_solver.hpp"

namespace tunica::linear {

/// A Krylov method with a list of preconditioners: where one stagnates (StagnationRule), cannot be
/// set up or reaches the cap on its iterations, the next one solves. That one serves the rest of
/// the time step and 1, 2, 4, … 64 steps more, twice as many each time that the first one fails
/// again; then the first one is tried once more. Which one a step begins with is part of what a
/// checkpoint keeps.
///
/// All ranks decide alike: by residuals and failures that are the same on all.
class SolverChain final : public LinearSolver {
public:
  /// options: a resolved "Linear Solver" list with "fallbacks".
  SolverChain(const Teuchos::ParameterList& options, const algebra::BlockMatrix& K,
              const NamedOperators& operators);

  void matrix_changed() override;
  void prepare() override;
  void forget() override;
  std::vector<double> save() const override;
  void restore(const std::vector<double>& numbers) override;
  std::vector<algebra::BlockVector> save_vectors() const override;
  void restore_vectors(const std::vector<algebra::BlockVector>& vectors) override;
  SolveReport solve(const algebra::BlockVector& b, algebra::BlockVector& x,
                    double tolerance) override;

private:
  struct Link {
    std::string name;
    std::function<std::unique_ptr<KrylovSolver>()> make;
    std::unique_ptr<KrylovSolver> solver;  ///< null before it is needed
    bool has_size_limit = false;
    std::string refusal{};  ///< why it cannot serve; empty where it can
    bool is_told = false;   ///< that it has come into use
  };

  KrylovSolver& present();
  /// Goes over to the next preconditioner that can serve; false where there is none. Collective.
  bool take_next(const std::string& why);
  /// When the present one is given up for the next that may serve.
  StagnationRule rule() const;
  void check_size(Link& link);
  SolveReport try_present(const algebra::BlockVector& b, algebra::BlockVector& x, double tolerance);

  std::vector<Link> links_;
  double most_factor_bytes_;
  std::size_t present_ = 0;
  int steps_held_ = 0;  ///< in which the present one is not the first one again
  int patience_ = 0;    ///< steps_held_ at the last failure of the first one
};

}  // namespace tunica::linear
