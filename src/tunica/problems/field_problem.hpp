#pragma once
#include <functional>
#include <memory>

#include "tunica/assembly/block_assembler.hpp"
#include "tunica/base/timer.hpp"
#include "tunica/fields/state.hpp"
#include "tunica/nonlinear/newton.hpp"

namespace tunica::problems {

/// What fluid and wall have in common: a state of two blocks per node, its residual and
/// Jacobian by loops over elements, and the solvers for them.
class FieldProblem : public nonlinear::NonlinearProblem,
                     public linear::NamedOperators,
                     public fields::Restartable {
public:
  ~FieldProblem() override;

  const fields::FieldMesh& mesh() const { return *mesh_; }
  const algebra::BlockVector& state() const { return x_; }
  /// Elements of all Jacobians so far and the time they took on this rank.
  const Throughput& jacobian_meter() const { return meter_; }

  /// Calls watch with the right-hand side before each linear solve. The Jacobian and the named
  /// operators are then those of the system.
  using SolveWatch = std::function<void(const algebra::BlockVector& b)>;
  void watch_solves(SolveWatch watch);
  const fields::BlockOperator& last_jacobian() const { return K_; }

  // Restartable
  fields::State save() const override;
  std::string restore(const fields::State& state) override;

  // NonlinearProblem
  const algebra::BlockSpacePtr& space() const override { return K_.space(); }
  bool residual(const algebra::BlockVector& x, algebra::BlockVector& F) override;
  void jacobian(const algebra::BlockVector& x) override;
  void apply_jacobian(const algebra::BlockVector& x, algebra::BlockVector& y) const override;
  linear::LinearSolver& linear_solver() override { return *solver_; }
  double increment_norm(const algebra::BlockVector& dx) override;

protected:
  /// list: the resolved "Fluid" or "Wall" list. mesh must outlive the problem. The derived
  /// constructor calls make_solver().
  FieldProblem(const Teuchos::ParameterList& list, const fields::FieldMesh& mesh);
  /// Not part of the constructor: preconditioners ask for the names of operators at once.
  void make_solver(const Teuchos::ParameterList& list);
  /// Newton's method from the present state, to which it goes back where it fails. What a step or
  /// an iteration prescribes stays.
  nonlinear::NewtonReport find_state();

  /// Takes the values at x to owned and ghost nodes. Collective.
  virtual void read(const algebra::BlockVector& x) = 0;
  /// False where the values read cannot be assembled, on all ranks alike.
  virtual bool is_admissible() { return true; }
  /// Fills R_, and K where it is not null, for the values read.
  virtual void assemble(assembly::BlockAssembler* K) = 0;
  /// The elements on which masses are taken.
  virtual const std::vector<kernels::Tet4>& geometry() const = 0;

  const fields::FieldMesh* mesh_;
  assembly::Constraints fixed_;  ///< per local node
  fields::BlockOperator K_;
  assembly::NodalResidual R_;
  algebra::BlockVector x_;

private:
  nonlinear::NewtonOptions newton_;
  std::unique_ptr<linear::LinearSolver> solver_;
  Throughput meter_;
};

}  // namespace tunica::problems
