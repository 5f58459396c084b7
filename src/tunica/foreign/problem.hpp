#pragma once
#include <memory>
#include <string>

#include "tunica/foreign/system_solver.hpp"
#include "tunica/systems/new_values.hpp"

namespace tunica::foreign {

/// Compressed rows of the calling rank, behind those of the ranks before.
struct OwnRows {
  long long count = 0;
  const long long* offsets = nullptr;  ///< count + 1 of them, from 0
  const long long* columns = nullptr;  ///< of the whole matrix, from 0
  const double* values = nullptr;
};

/// Seconds of the last call of each kind, of the slowest rank.
struct Seconds {
  double set_up = 0.0, refresh = 0.0, solve = 0.0;
};

/// K x = b of a program that calls, for one matrix after the other on the same pattern and any
/// right-hand sides.
class Problem {
public:
  /// settings: a case of tunica-solvers in XML, or the path of one; "" leaves all to the matrix.
  /// Throws Error on all ranks for what does not fit. Collective, as all others.
  Problem(const OwnRows& rows, const std::string& settings, const CommPtr& comm);
  ~Problem();

  /// New values on the same pattern. Numeric work only, where what was found in the old ones holds;
  /// otherwise all anew. Returns why it does not hold, or nothing.
  std::string refresh(const double* values);
  /// x of the rank's rows, the nearest one found. Solves from zero.
  Answer solve(const double* b, double* x);

  /// |b − K x| / |b| of the last solve, in the units of the caller.
  double residual() const { return residual_; }
  const Seconds& seconds() const { return seconds_; }
  /// What was found in K, and what is doubtful, a line each; on rank 0.
  std::string notes() const;
  const std::string& setting() const { return solver_->setting().name; }
  /// The setting in use, as a case.
  std::string case_in_use() const;
  long long n_unknowns() const { return system_->K.n_unknowns(); }

private:
  void set_up(const double* values);
  Answer answer_to(const Vector& right, algebra::BlockVector& y);

  CommPtr comm_;
  systems::SparseRows pattern_;  ///< of the caller's rows, whatever their portion is
  Teuchos::RCP<const Map> rows_;
  Teuchos::ParameterList options_;
  std::vector<double> values_;  ///< of a matrix with a border, which may have to go back in
  std::unique_ptr<systems::System> system_;
  std::unique_ptr<systems::NewValues> new_values_;
  std::unique_ptr<SystemSolver> solver_;
  std::vector<std::string> doubts_;  ///< about the right-hand side
  double residual_ = 0.0;
  Seconds seconds_;
};

}  // namespace tunica::foreign
