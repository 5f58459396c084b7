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
  std::vector<algebra::BlockVector> save_vectors() const override {
    return solver_->save_vectors();
  }
  void restore_vectors(const std::vector<algebra::BlockVector>& vectors) override {
    solver_->restore_vectors(vectors);
  }
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

std::string name_of(std::size_t vector, const algebra::Block& block) {
  return "linear solver " + std::to_string(vector) + " " + block.name;
}

}  // namespace

void save_solver(const linear::LinearSolver& solver, const fields::SplitMesh* split,
                 fields::State& state) {
  const std::vector<double> numbers = solver.save();
  // A fresh solver has nothing to keep.
  if (!numbers.empty()) state.numbers[solver_numbers] = numbers;
  const std::vector<algebra::BlockVector> vectors = solver.save_vectors();
  for (std::size_t k = 0; k < vectors.size(); ++k)
    for (int b = 0; b < vectors[k].n_blocks(); ++b)
      state.arrays[name_of(k, (*vectors[k].space())[b])] = fields::rows_of(vectors[k], b, split);
}

bool has_solver(const fields::State& state, const algebra::BlockSpace& space) {
  return state.numbers.count(solver_numbers) > 0 || state.has_array(name_of(0, space[0]));
}

void restore_solver(const fields::State& state, const algebra::BlockSpacePtr& space,
                    const fields::SplitMesh* split, linear::LinearSolver& solver) {
  const auto numbers = state.numbers.find(solver_numbers);
  solver.restore(numbers == state.numbers.end() ? std::vector<double>() : numbers->second);
  std::vector<algebra::BlockVector> vectors;
  while (state.has_array(name_of(vectors.size(), (*space)[0]))) {
    const std::size_t k = vectors.size();
    algebra::BlockVector& x = vectors.emplace_back(space);
    for (int b = 0; b < x.n_blocks(); ++b) {
      const algebra::Block& block = (*space)[b];
      const int length = fields::row_length(block, split);
      fields::assign_rows(state.array(name_of(k, block), length), b, split, x);
    }
  }
  solver.restore_vectors(vectors);
}

}  // namespace tunica::problems
