#include "tunica/problems/watched_solver.hpp"

namespace tunica::problems {

namespace {

class WatchedSolver final : public linear::LinearSolver {
public:
  WatchedSolver(std::unique_ptr<linear::LinearSolver> solver, SolveWatch watch)
      : solver_(std::move(solver)), watch_(std::move(watch)) {}

  void matrix_changed() override { solver_->matrix_changed(); }
  void prepare() override { solver_->prepare(); }
  void forget() override { solver_->forget(); }
  linear::SolveReport solve(const algebra::BlockVector& b, algebra::BlockVector& x,
                            double tolerance) override {
    watch_(b);
    return solver_->solve(b, x, tolerance);
  }

private:
  std::unique_ptr<linear::LinearSolver> solver_;
  SolveWatch watch_;
};

}  // namespace

std::unique_ptr<linear::LinearSolver> watched(std::unique_ptr<linear::LinearSolver> solver,
                                              SolveWatch watch) {
  return std::make_unique<WatchedSolver>(std::move(solver), std::move(watch));
}

}  // namespace tunica::problems
