#pragma once
#include <functional>
#include <memory>

#include "tunica/fields/block_operator.hpp"
#include "tunica/fields/state.hpp"
#include "tunica/linear/linear_solver.hpp"

namespace tunica::problems {

/// Called with the right-hand side before each linear solve.
using SolveWatch = std::function<void(const algebra::BlockVector& b)>;

/// The solver, which shows each right-hand side to watch before it solves.
std::unique_ptr<linear::LinearSolver> watched(std::unique_ptr<linear::LinearSolver> solver,
                                              SolveWatch watch);

/// Saves the state of a solver for a checkpoint, and restores it.
/// split: carries the scalars of its unknowns where it is not null.
void save_solver(const linear::LinearSolver& solver, const fields::SplitMesh* split,
                 fields::State& state);
bool has_solver(const fields::State& state, const algebra::BlockSpace& space);
void restore_solver(const fields::State& state, const algebra::BlockSpacePtr& space,
                    const fields::SplitMesh* split, linear::LinearSolver& solver);

/// A problem whose linear systems can be looked at.
class SystemSource {
public:
  virtual ~SystemSource() = default;

  /// Calls watch before each linear solve. The Jacobian and the named operators are then those of
  /// the system.
  virtual void watch_solves(SolveWatch watch) = 0;
  /// The Jacobian assembled last, and the operators that belong to it.
  virtual const fields::BlockOperator& last_jacobian() const = 0;
  virtual const linear::NamedOperators& operators() const = 0;
};

}  // namespace tunica::problems
