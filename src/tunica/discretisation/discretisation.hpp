#pragma once
#include "tunica/algebra/block_matrix.hpp"
#include "tunica/base/outcome.hpp"
#include "tunica/linear/named_operators.hpp"

namespace tunica::discretisation {

/// What becomes of the equations of a field on a mesh and in a time step: the residual F(x) and
/// the blocks of its Jacobian at a state x, and no solver. What a step or a coupling iteration
/// prescribes is set before. All members are collective.
class Discretisation : public linear::NamedOperators {
public:
  virtual const algebra::BlockSpacePtr& space() const = 0;

  /// F at x, or why x is not admissible (an inverted element), the same on all ranks. Rows of
  /// constrained unknowns are zero.
  virtual Outcome residual(const algebra::BlockVector& x, algebra::BlockVector& F) = 0;

  /// Brings jacobian() to x.
  virtual void assemble_jacobian(const algebra::BlockVector& x) = 0;
  virtual const algebra::BlockMatrix& jacobian() const = 0;

  /// (dxᵀ M dx)^½ with the mass matrices of all unknowns, the norm of [LY1] newstop.
  virtual double mass_norm(const algebra::BlockVector& dx) const = 0;

  // NamedOperators: none
  std::vector<std::string> operator_names() const override { return {}; }
  Teuchos::RCP<const CrsMatrix> assemble_operator(const std::string&) const override {
    return Teuchos::null;
  }
};

}  // namespace tunica::discretisation
