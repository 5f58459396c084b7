#pragma once
#include <functional>

#include "tunica/base/outcome.hpp"
#include "tunica/problems/solid_problem.hpp"

namespace tunica::problems {

/// A vessel is imaged under pressure, and its mesh is not free of stress. Sought is the prestretch
/// G of its elements, det G > 0, with which the wall is in equilibrium where it was imaged, under a
/// pressure p in the lumen and the loads that it has at the start. By one of two methods:
///
/// "deformation gradient", the incremental one [Ge10]: G need not be that of any shape.
///
///   u  equilibrium of the wall with G,     G ← (I + ∇s) G,     s = u, accelerated
///
/// All loads are raised in increments, of one equilibrium each, and at all of them it is repeated
/// until u, the way that the wall is still off the mesh, is short. Springs and dashpots of the
/// tissue are at rest there, so that it carries the wall only on the way.
///
/// "stress-free shape": that of a shape X without stress which the loads deform to the mesh x,
///
///   X + d(X) = x,     X ← X − (X + d(X) − x),     G = ∂x/∂X
///
/// accelerated likewise [Se11]. There is no such shape where a soft wall has a sharp fork, and
/// where tissue holds the wall the iteration creeps.
struct Prestress {
  std::vector<Mat3> prestretch;  ///< of local elements; empty: the identity
  algebra::BlockVector state;    ///< no displacement, and the pressure that bears the load
};

/// How far the search has come.
struct PrestressPoint {
  double load = 0.0;  ///< part of the loads that is borne
  double step = 0.0;  ///< by which it is raised next; 0: as the case says
  int load_step = 0;
};

/// An equilibrium on the way.
struct PrestressIteration {
  int load_step, iteration;
  double load;           ///< part of the loads
  int newton, linear;    ///< Newton steps and iterations of the linear solver
  double moved;          ///< largest displacement from the mesh [mm]
  double goal;           ///< of it [mm]; 0 where another load follows
  double least, most;    ///< det G
  double seconds;        ///< it took
  std::string reason{};  ///< why it was given up; empty where it was not
};

/// What looks on.
struct PrestressWatch {
  /// After each equilibrium.
  std::function<void(const PrestressIteration&)> report = [](const auto&) {};
  /// After each that was accepted, with all that a search needs to go on there. False ends the
  /// search as a failure with the reason "stopped". Collective.
  std::function<bool(const PrestressPoint&, const Prestress&)> goes_on =
      [](const auto&, const auto&) { return true; };
};

/// list: the resolved "Wall" list; wall: on the mesh, gives its fibres, and the prestretch and
/// pressure where an earlier search stood at the point. Fails where an equilibrium is not found, G
/// is inverted somewhere, or the iteration does not end. Collective.
Result<Prestress> find_prestress(const Teuchos::ParameterList& list, const SolidProblem& wall,
                                 const PrestressWatch& watch, const PrestressPoint& from = {});

/// True where the "Wall" list asks for it.
bool wants_prestress(const Teuchos::ParameterList& list);
std::vector<std::string> prestress_surfaces(const Teuchos::ParameterList& list);

params::Table prestress_table();

}  // namespace tunica::problems
