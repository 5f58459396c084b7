#pragma once
#include <deque>
#include <memory>
#include <optional>
#include <string>

#include "tunica/coupling/added_mass.hpp"
#include "tunica/coupling/scheme.hpp"
#include "tunica/problems/fluid_problem.hpp"
#include "tunica/problems/mesh_motion.hpp"
#include "tunica/problems/solid_problem.hpp"

namespace tunica::coupling {

/// A resolved "Coupling" list of this scheme.
struct DirichletNeumannSettings {
  DirichletNeumannSettings(  // NOLINT: a list is what is not decoded
      const Teuchos::ParameterList& list);

  int max_iterations;
  double tolerance;          ///< ε of |r|/√n < ε, n the vertices of the interface [mm]
  int predictor_order;       ///< 0: last displacement, 1: linear, 2: quadratic in time
  double largest_update;     ///< of a displacement component in one iteration [mm]; 0: any
  int halvings;              ///< of an update that a field cannot follow, in a row
  bool accepts_unconverged;  ///< go on with a warning where a step does not converge
  std::optional<Teuchos::ParameterList> added_mass;  ///< solver; none: residuals stay as they are
  std::string accelerator;
  Teuchos::ParameterList list;  ///< in which the accelerator finds its own keys
};
params::Table dirichlet_neumann_table();

/// Dirichlet–Neumann coupling ([LY1] section 5.1): mesh motion and fluid for a given interface
/// displacement d, wall for the fluid's force, d̃ its answer, until r = d̃ − d is small. The
/// accelerator makes the next d from r, or from what a preconditioner makes of r. Where one of the
/// three problems fails, d goes back half of the way to where they last did not.
class DirichletNeumann final : public Scheme {
public:
  /// The problems must outlive the object.
  DirichletNeumann(const DirichletNeumannSettings& settings,
                   const fields::InterfaceTransfer& interface, problems::FluidProblem& fluid,
                   problems::SolidProblem& wall, problems::MeshMotion& motion);

  static constexpr const char* scheme_name = "dirichlet-neumann";

  // Scheme
  std::vector<std::string> fields() const override { return {"fluid", "wall"}; }
  std::vector<std::string> stages() const override { return {"motion", "fluid", "wall", "update"}; }
  std::vector<std::pair<std::string, problems::SystemSource*>> systems() override {
    return {{"fluid", fluid_}, {"wall", wall_}};
  }
  void watch_newton(const NewtonWatch& watch) override;

  // Restartable: what belongs to the coupling alone, without the three problems
  fields::State save() const override;
  std::string restore(const fields::State& state) override;

private:
  // Scheme
  Outcome begin(const stepping::Clock& clock) override;
  Report solve(const stepping::Clock& clock, const Watch& watch) override;

  /// Makes the preconditioner from fluid and wall as they lie; with the compliance of an earlier
  /// step where the wall cannot be solved. Fails where there is none.
  Outcome set_preconditioner(const stepping::Clock& clock);
  InterfaceVector predict(const stepping::Clock& clock) const;
  /// Runs the three problems for d; the answer is the wall's. Fails where one of them does.
  Outcome evaluate(const InterfaceVector& d, Iteration& iteration, InterfaceVector& answer);
  Outcome move_and_flow(const InterfaceVector& d, Iteration& iteration);
  /// Takes d to the next iterate; true, and d stays, where its residual is small.
  bool update(InterfaceVector& d, const InterfaceVector& answer, Iteration& iteration);
  /// Takes d half of the way to where the fields last followed; false where that is of no use.
  bool go_back(InterfaceVector& d, const InterfaceVector& reached, int n_failed) const;
  std::string why_unconverged(double time, const Report& report) const;
  InterfaceVector limited(const InterfaceVector& d, InterfaceVector next) const;
  InterfaceVector wall_displacement() const;
  double size_of(const InterfaceVector& residual) const;
  void accept();
  /// Reports a failure of the preconditioner, once.
  std::string remark_on(double time);

  DirichletNeumannSettings options_;
  const fields::InterfaceTransfer* interface_;
  problems::FluidProblem* fluid_;
  problems::SolidProblem* wall_;
  problems::MeshMotion* motion_;
  std::unique_ptr<AddedMass> preconditioner_;
  /// Last compliance of the wall, used if a new one cannot be computed, also after a restart.
  std::optional<std::vector<double>> compliance_;
  std::string remark_;  ///< to be told with the next report
  bool has_told_compliance_ = false, has_told_relaxation_ = false;
  std::unique_ptr<Accelerator> accelerator_;
  stepping::Timeline displacements_;  ///< accepted ones, of three steps
};

}  // namespace tunica::coupling
