#pragma once
#include <memory>
#include <string>
#include <vector>

#include "tunica/algebra/block_matrix.hpp"
#include "tunica/linear/named_operators.hpp"
#include "tunica/linear/preconditioner_registry.hpp"
#include "tunica/params/table.hpp"

namespace tunica::linear {

/// Outcome of one linear solve. Not converging is a result, not an error.
struct SolveReport {
  std::string method;
  std::string preconditioner;  ///< as XML names it
  bool is_converged = false;
  bool has_stagnated = false;  ///< given up before its end
  int iterations = 0;
  int operator_applications = 0;     ///< products with K on the way
  double tolerance = 0.0;            ///< asked for: |b − Kx| ≤ tolerance |b|
  double recurrence_residual = 0.0;  ///< relative, as the Krylov method believes
  /// Relative, |b − Kx| / |b|: computed anew, or that of GCR where it had no time to drift
  double true_residual = 0.0;
  double setup_seconds = 0.0;
  double solve_seconds = 0.0;
  /// Reports of all preconditioners if more than one was tried, the last one last. The numbers of
  /// the whole are their sums, and residuals of the last.
  std::vector<SolveReport> attempts;
  multigrid::Levels levels;  ///< none where the preconditioner is no multigrid for the whole system
};

/// Iterations, products and seconds of one solve, of those of all.
void add_costs(const SolveReport& of_one, SolveReport& all);

/// By how much an unconverged solve fell short, in words.
std::string describe_unconverged(const SolveReport& report);

/// Solves with the Jacobian of one field, K x = b.
class LinearSolver {
public:
  virtual ~LinearSolver() = default;

  /// The values of K are new: what was set up for the old ones may be kept or refreshed.
  virtual void matrix_changed() = 0;

  /// Sets everything up for the present values, though what is there might do. Collective.
  virtual void prepare() = 0;

  /// Lets nothing that earlier solves have left, a preconditioner or directions, serve a later one.
  virtual void forget() = 0;

  /// State that forget() keeps, for a checkpoint: the preconditioner in use, if there are several,
  /// and what its set-ups have learnt. Empty if it is the first, and has learnt nothing.
  virtual std::vector<double> save() const { return {}; }
  virtual void restore(const std::vector<double>& numbers) { static_cast<void>(numbers); }
  /// Vectors that forget() keeps: solutions with which the next set-up begins. To be restored after
  /// the numbers.
  virtual std::vector<algebra::BlockVector> save_vectors() const { return {}; }
  virtual void restore_vectors(const std::vector<algebra::BlockVector>& vectors) {
    static_cast<void>(vectors);
  }

  /// Solves from a zero start. Throws SetupFailure on all ranks where that cannot be set up, and
  /// StopRequest where a signal wants to end the program. Collective.
  virtual SolveReport solve(const algebra::BlockVector& b, algebra::BlockVector& x,
                            double tolerance) = 0;
};

/// Key of GCR: iterations that may be to come where it is slow; 0: any.
inline constexpr const char* give_up_at = "give up at";

/// The keys of a "Linear Solver" list.
params::Table linear_solver_table(const SolverDefaults& defaults = {});

/// The keys of one within a preconditioner, with its "tolerance".
params::Table inner_solver_table(SolverDefaults defaults);

/// Builds the solver that the resolved list describes; K and operators must outlive it. The
/// low-rank part of K is included in products; preconditioners and factors of its blocks are
/// extended to all of K (low_rank.hpp).
std::unique_ptr<LinearSolver> make_linear_solver(const Teuchos::ParameterList& options,
                                                 const algebra::BlockMatrix& K,
                                                 const NamedOperators& operators = no_operators());

}  // namespace tunica::linear
