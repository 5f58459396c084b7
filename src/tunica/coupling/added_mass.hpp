#pragma once
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "tunica/coupling/accelerator.hpp"
#include "tunica/fields/block_operator.hpp"
#include "tunica/fields/interface_transfer.hpp"
#include "tunica/linear/scalar_solver.hpp"
#include "tunica/problems/solid_problem.hpp"

namespace tunica::coupling {

/// Input of the added-mass model.
struct AddedMassModel {
  std::vector<Vec3> positions;     ///< of the fluid's local nodes [mm]
  std::vector<Vec3> area;          ///< boundary::nodal_areas of the interface there [mm²]
  std::vector<int> open_surfaces;  ///< of the fluid: p = 0
  double fluid_inertia;            ///< m = ρ_f/Δt² of implicit Euler [kPa/mm²]
  /// c ≥ 0 of the owned nodes of the interface: what unit pressure moves the wall by within one
  /// time step [mm/kPa].
  std::vector<double> compliance;
};

/// Takes the fluid's added mass out of an interface residual r:
///
///   P r = r − c p n,   −Δp = 0 in the fluid as it lies,
///                      ∂p/∂n = m (n·r − c p) on the interface, p = 0 on open surfaces
///
///   n  normal of the interface, out of the fluid                                  1
///   p  how much less the fluid presses once the wall has moved by P r             kPa
///
/// For an inviscid fluid and a wall that moves by c p wherever p acts, d + P r is the solution if r
/// is the residual at d. Tangential residuals are left alone: no pressure answers to them.
///
/// Source: the operators of [CGN], who show what relaxation the added mass asks for.
/// Deviation: a number per node in place of the wall's operator; lumped masses on the interface.
/// A wall with fluid on both sides hardly moves under pressure on its whole surface: c says
/// nothing about such a one.
class AddedMass {
public:
  /// list: a resolved list of linear::scalar_solver_table(); graph: of the nodes of the fluid's
  /// mesh. Collective.
  AddedMass(const Teuchos::ParameterList& list, const fields::FieldMesh& mesh,
            const fields::NodeGraph& graph, const fields::InterfaceTransfer& interface,
            const AddedMassModel& model);

  /// P r; r itself where the linear solver fails, which is no worse than no P. Collective.
  InterfaceVector apply(const InterfaceVector& residual);
  /// apply() has given a residual back as it was.
  bool has_failed() const { return has_failed_; }

private:
  const fields::InterfaceTransfer* interface_;
  std::vector<double> compliance_;  ///< of the owned interface nodes
  std::vector<Vec3> normal_;
  std::vector<double> weight_;  ///< m times their area, 0 on open surfaces
  std::unique_ptr<linear::ScalarSolver> solver_;
  MultiVector right_side_, p_;
  bool has_failed_ = false;
};

/// The normal displacement of the owned interface nodes under unit pressure on the whole interface
/// [mm/kPa], of the wall at its present state. Fails where the wall's linear solver does. Comes
/// after SolidProblem::begin_step(), and sets up that solver. Collective. area: area times normal,
/// out of the fluid, of the owned nodes of the fluid [mm²].
Result<std::vector<double>> wall_compliance(const fields::InterfaceTransfer& interface,
                                            const std::vector<Vec3>& area,
                                            problems::SolidProblem& wall);

}  // namespace tunica::coupling
