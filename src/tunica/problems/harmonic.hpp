#pragma once
#include <memory>
#include <optional>
#include <string>

#include "tunica/fields/field_mesh.hpp"
#include "tunica/linear/scalar_solver.hpp"

namespace tunica::problems {

/// Harmonic functions on the undeformed mesh of a field: −Δφ = 0, φ given at some nodes, no flux
/// through the rest of the boundary. Several functions with the same given nodes at once.
class Harmonic {
public:
  /// solver: a resolved list of linear::scalar_solver_table(); is_given: one flag per local node;
  /// columns: how many functions. mesh must outlive it. Collective.
  Harmonic(const Teuchos::ParameterList& solver, const fields::FieldMesh& mesh,
           std::vector<char> is_given, int columns);

  /// values: on entry those of the given nodes, zero elsewhere; on return those of all nodes.
  /// Begins with the last solution. Says why where the linear solver fails. Collective.
  std::optional<std::string> extend(MultiVector& values);
  /// Makes the next extend() begin with these values of all nodes.
  void start_from(const MultiVector& values);

private:
  const fields::FieldMesh* mesh_;
  std::vector<char> is_given_;
  Teuchos::RCP<CrsMatrix> K_;      ///< rows and columns of given nodes are diagonal
  Teuchos::RCP<CrsMatrix> whole_;  ///< the Laplacian without conditions
  std::unique_ptr<linear::ScalarSolver> solver_;
  MultiVector solution_;
};

}  // namespace tunica::problems
