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
  std::vector<double> save() const override { return solver_->save(); }
  void restore(const std::vector<double>& numbers) override { solver_->restore(numbers); }
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

namespace {

constexpr const char* solver_numbers = "linear solver";

}  // namespace

void save_solver(const linear::LinearSolver& solver, fields::State& state) {
  const std::vector<double> numbers = solver.save();
  // A fresh solver has nothing to keep.
  if (!numbers.empty()) state.numbers[solver_numbers] = numbers;
}

bool has_solver(const fields::State& state) { return state.numbers.count(solver_numbers) > 0; }

void restore_solver(const fields::State& state, linear::LinearSolver& solver) {
  solver.restore(has_solver(state) ? state.numbers.at(solver_numbers) : std::vector<double>());
}

}  // namespace tunica::problems
