#pragma once
#include <memory>
#include <optional>
#include <vector>

#include "tunica/base/outcome.hpp"
#include "tunica/discretisation/extension.hpp"
#include "tunica/linear/scalar_solver.hpp"
#include "tunica/problems/mesh_motion_settings.hpp"

namespace tunica::problems {

/// How well an extension is solved for.
struct ExtensionAccuracy {
  std::optional<double> tolerance;  ///< the relative residual left, if not that of the list
  /// Enough, where that is more: this part of the residual of the last solution, of which no more
  /// than a hundredth counts, as where there was none, or one of an attempt that failed.
  double reduction = 0.0;
};

/// Solves for extensions of what is given at some nodes. The linear system is that of the free
/// nodes, of which there may be few, or none.
class ExtensionProblem {
public:
  /// solver: a resolved list of linear::scalar_solver_table(); extension: must outlive the object;
  /// columns: how many functions with the same given nodes at once. Collective.
  ExtensionProblem(const Teuchos::ParameterList& solver,
                   const discretisation::HarmonicExtension& extension, int columns);
  ExtensionProblem(const Teuchos::ParameterList& solver,
                   const discretisation::ElasticExtension& extension);

  /// values: on entry those of the given nodes, zero elsewhere; on return those of all nodes.
  /// Begins with the last solution. Says why where the linear solver fails. Collective.
  Outcome extend(MultiVector& values, const ExtensionAccuracy& accuracy = {});
  /// Extends from a zero start, to a relative residual of its own: values that are small compared
  /// with others are not more accurate. If the solver fails, its result is used with its error.
  void extend_roughly(double tolerance, MultiVector& values) const;
  /// Makes the next extend() begin with these values of all nodes.
  void start_from(const MultiVector& values);

private:
  MultiVector right_side(const MultiVector& given) const;

  const discretisation::Extension* extension_;
  std::vector<int> free_;                         ///< owned nodes
  std::unique_ptr<linear::ScalarSolver> solver_;  ///< null where no rank has free nodes
  MultiVector solution_;                          ///< at the free nodes
};

/// The extension of a displacement by the law of a mesh's motion, and the problem that solves for
/// it.
class LawExtension {
public:
  /// Arguments and what they mean: see discretisation::Extension. Lines, which cannot shear, are
  /// always harmonic. mesh must outlive the object. Collective.
  LawExtension(const MeshMotionSettings& settings, const fields::FieldMesh& mesh,
               const std::vector<char>& is_given, discretisation::Extent extent);
  ExtensionProblem& problem() { return *problem_; }

private:
  std::unique_ptr<discretisation::Extension> extension_;
  std::unique_ptr<ExtensionProblem> problem_;
};

}  // namespace tunica::problems
