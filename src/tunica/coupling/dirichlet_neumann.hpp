#pragma once
#include <cmath>
#include <deque>
#include <functional>
#include <memory>

#include "tunica/coupling/added_mass.hpp"
#include "tunica/fields/interface.hpp"
#include "tunica/problems/fluid_problem.hpp"
#include "tunica/problems/mesh_motion.hpp"
#include "tunica/problems/solid_problem.hpp"

namespace tunica::coupling {

struct CouplingOptions {
  int max_iterations;
  double tolerance;          ///< ε of |r|/√n < ε, n the vertices of the interface [mm]
  int predictor_order;       ///< 0: last displacement, 1: linear, 2: quadratic in time
  double largest_update;     ///< of a displacement component in one iteration [mm]; 0: any
  int halvings;              ///< of an update that a field cannot follow, in a row
  bool accepts_unconverged;  ///< go on with a warning where a step does not converge
};
params::Table coupling_table();
CouplingOptions coupling_options(const Teuchos::ParameterList& list);

/// One Dirichlet–Neumann iteration.
struct Iteration {
  double residual = std::nan("");  ///< |r|/√n [mm]; not a number where a field failed
  double relaxation = 0.0;
  int columns = 0;
  nonlinear::NewtonReport fluid, wall;
  double motion_seconds = 0.0, fluid_seconds = 0.0, wall_seconds = 0.0;
  double update_seconds = 0.0;  ///< preconditioner and accelerator
};

/// What became of a time step.
struct Report {
  bool is_converged = false;
  bool is_accepted = false;  ///< converged, or not and accepted as the options say
  std::string reason;        ///< why not
  std::vector<Iteration> iterations;

  int newton_steps(nonlinear::NewtonReport Iteration::*field) const;
  int linear_iterations(nonlinear::NewtonReport Iteration::*field) const;
};

/// Dirichlet–Neumann coupling ([LY1] section 5.1): mesh motion and fluid for a given interface
/// displacement d, wall for the fluid's force, d̃ its answer, until r = d̃ − d is small. The
/// accelerator makes the next d from r, or from what a preconditioner makes of r. Where one of the
/// three problems fails, d goes back half of the way to where they last did not.
class DirichletNeumann : public fields::Restartable {
public:
  /// list: the resolved "Coupling" list. The problems must outlive the object.
  DirichletNeumann(const Teuchos::ParameterList& list, const fields::Interface& interface,
                   problems::FluidProblem& fluid, problems::SolidProblem& wall,
                   problems::MeshMotion& motion);

  /// Makes the preconditioner for the clock's present step, before which it is to be called, from
  /// fluid and wall as they lie; keeps that of an earlier step where the wall cannot be solved.
  /// Says why where there is none. Collective.
  std::optional<std::string> prepare(const stepping::Clock& clock);

  /// Solves the clock's present step and accepts it as far as the options allow. watch is
  /// called after every iteration with its number, counted from 1.
  Report solve_step(const stepping::Clock& clock,
                    const std::function<void(int, const Iteration&)>& watch);

  // Restartable: what belongs to the coupling alone, without the three problems
  fields::State save() const override;
  std::string restore(const fields::State& state) override;

private:
  InterfaceVector predict() const;
  /// Runs the three problems for d. False, with a reason, where one of them fails.
  bool respond(const InterfaceVector& d, Iteration& iteration, InterfaceVector& answer,
               std::string& reason);
  bool move_and_flow(const InterfaceVector& d, Iteration& iteration, std::string& reason);
  /// Takes d to the next iterate; true, and d stays, where its residual is small.
  bool update(InterfaceVector& d, const InterfaceVector& answer, Iteration& iteration);
  /// Takes d half of the way to where the fields last followed; false where that is of no use.
  bool go_back(InterfaceVector& d, const InterfaceVector& reached, int n_failed) const;
  std::string why_unconverged(double time, const Report& report) const;
  InterfaceVector limited(const InterfaceVector& d, InterfaceVector next) const;
  InterfaceVector wall_displacement() const;
  double size_of(const InterfaceVector& residual) const;
  void accept();

  CouplingOptions options_;
  const fields::Interface* interface_;
  problems::FluidProblem* fluid_;
  problems::SolidProblem* wall_;
  problems::MeshMotion* motion_;
  std::optional<Teuchos::ParameterList> added_mass_;  ///< solver; none: residuals stay as they are
  std::unique_ptr<AddedMass> preconditioner_;
  std::string accelerator_kind_;
  std::unique_ptr<Accelerator> accelerator_;
  std::deque<InterfaceVector> history_;  ///< accepted displacements, newest first, at most 3
};

}  // namespace tunica::coupling
