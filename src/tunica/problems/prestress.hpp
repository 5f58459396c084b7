#pragma once
#include <functional>

#include "tunica/base/outcome.hpp"
#include "tunica/problems/solid_problem.hpp"
#include "tunica/problems/tissue_hold.hpp"

namespace tunica::problems {

/// A vessel is imaged under pressure, and its mesh is not free of stress. Sought is the prestretch
/// G of its elements, det G > 0, with which the wall is in balance where it was imaged, under a
/// pressure p in the lumen and the loads that it has at the start:
///
///   R(G, p) = 0,     K s = −R,     K the derivative by s in G ← (I + ε) G,  ε = ½ (∇s + ∇sᵀ)
///
/// By one of two methods, which differ in what they make of the steps s on the nodes:
///
///   "deformation gradient"   G ← exp(ε) G, increments of a gradient [Ge10] without their rotation
///   "stress-free shape"      G = ∂x/∂X, X ← X − s, of the shape X without stress [Se11]
///
/// K is exact for the first. There is no such shape where a soft wall has a sharp fork. All loads
/// are raised in increments, and at all of them steps go on until they are short.
///
/// Springs of the tissue are at rest in the mesh, and the wall bears the loads alone, if it can.
/// Where it cannot ("deformation gradient"), springs have a stretch o in the mesh:
///
///   R(G, p, o) = R(G, p) + k o = 0,     o ← o + s
///
/// and are released step by step, while the wall bears what they let go and that is worth it.
struct Prestress {
  std::vector<Mat3> prestretch;  ///< of local elements; empty: the identity
  algebra::BlockVector state;    ///< no displacement, and the pressure that bears the load
  std::vector<Vec3> offset{};    ///< o on owned and ghost nodes [mm]; empty: zero
};

/// How far the search has come.
struct PrestressPoint {
  double load = 0.0;  ///< part of the loads that is borne
  double step = 0.0;  ///< by which it is raised next; 0: as the case says
  int load_step = 0;
  bool leans = false;         ///< on the springs of the tissue
  int releases = 0;           ///< of them that are done or have begun
  std::vector<Vec3> shape{};  ///< x − X on owned nodes [mm], where a shape is sought
};

/// A step of Newton's method.
struct PrestressIteration {
  int load_step, iteration;
  double load;           ///< part of the loads
  int linear;            ///< iterations of the linear solver
  double moved;          ///< the largest step [mm]
  double goal;           ///< of it [mm]; 0 where another load follows
  double residual;       ///< what is out of balance, in parts of what was before
  double least, most;    ///< det G
  TissueHold tissue;     ///< what springs hold
  double seconds;        ///< it took
  std::string reason{};  ///< why it was given up; empty where it was not
};

/// Observer of the search.
struct PrestressWatch {
  /// After each step.
  std::function<void(const PrestressIteration&)> report = [](const auto&) {};
  /// A sentence about a turn that the search takes, or about its end.
  std::function<void(const std::string&)> say = [](const auto&) {};
  /// After each load that is borne, and after each step at all of the load, with what a search
  /// needs to go on there. False ends the search as a failure with the reason "stopped".
  /// Collective.
  std::function<bool(const PrestressPoint&, const Prestress&)> goes_on =
      [](const auto&, const auto&) { return true; };
};

/// wall: of these settings, on the mesh, gives its fibres, and where an earlier search
/// stood at the point its prestretch, pressure and springs. Fails where no step leaves less out of
/// balance, however small the increment, or the steps do not get short. Throws StopRequest where a
/// signal ends it within a step. Collective.
Result<Prestress> find_prestress(const SolidSettings& settings, const SolidProblem& wall,
                                 const PrestressWatch& watch, const PrestressPoint& from = {});

/// Options in a resolved "Prestress" list.
PrestressOptions prestress_options(const Teuchos::ParameterList& list);

params::Table prestress_table();

}  // namespace tunica::problems
