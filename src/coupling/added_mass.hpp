#pragma once
#include "coupling/accelerator.hpp"
#include "fields/interface.hpp"
#include "linear/scalar_solver.hpp"
#include "problems/fluid_problem.hpp"
#include "problems/solid_problem.hpp"

namespace tunica::coupling {

/// Takes the fluid's added mass out of an interface residual r:
///
///   P r = r − c p n,   −Δp = 0 in the undeformed fluid,
///                      ∂p/∂n = m (n·r − c p) on the interface, p = 0 on open surfaces
///
///   n  normal of the undeformed interface, out of the fluid                       1
///   c  compliance: what unit pressure moves the wall by within one time step      mm/kPa
///   m  ρ_f/Δt², the fluid's inertia for implicit Euler                            mg/(mm³ ms²)
///   p  how much less the fluid presses once the wall has moved by P r             kPa
///
/// For an inviscid fluid and a wall that moves by c p wherever p acts, d + P r is the solution if r
/// is the residual at d. Tangential residuals are left alone: no pressure answers to them.
///
/// Source: the operators of [CGN], who show what relaxation the added mass asks for.
class AddedMass {
public:
  /// list: a resolved list of linear::scalar_solver_table(). compliance: of the owned nodes of the
  /// interface, ≥ 0; fluid_inertia: m. Collective.
  AddedMass(const Teuchos::ParameterList& list, const fields::FieldMesh& fluid,
            const fields::Interface& interface, const std::vector<int>& open_surfaces,
            const std::vector<double>& compliance, double fluid_inertia);

  /// P r. The linear solver may fall short of its tolerance: P must be near, not exact.
  /// Collective.
  InterfaceVector apply(const InterfaceVector& residual);

private:
  const fields::Interface* interface_;
  std::vector<double> compliance_;  ///< of the owned interface nodes
  std::vector<Vec3> normal_;
  std::vector<double> weight_;  ///< m times their area, 0 on open surfaces
  std::unique_ptr<linear::ScalarSolver> solver_;
  MultiVector right_side_, p_;
};

/// The compliance of AddedMass of the wall at rest: normal displacement of the owned interface
/// nodes under unit pressure on the whole interface [mm/kPa]. Throws Error where the wall's linear
/// solver fails. Collective.
std::vector<double> wall_compliance(const stepping::Clock& clock, const fields::FieldMesh& fluid,
                                    const fields::Interface& interface,
                                    problems::SolidProblem& wall);

}  // namespace tunica::coupling
