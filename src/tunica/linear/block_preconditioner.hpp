#pragma once
#include <Teuchos_ParameterList.hpp>

#include "tunica/algebra/concatenation.hpp"
#include "tunica/linear/named_operators.hpp"

namespace tunica::linear {

/// A preconditioner of a block system from a Stratimikos list, as Trilinos users write
/// them: "Preconditioner Type" = "Teko" with an "Inverse Factory Library", in which our block
/// LU strategies (lu_strategy.hpp) stand beside Teko's own, MueLu, Ifpack2 and Amesos2.
class BlockPreconditioner : public Operator {
public:
  /// The objects referred to must outlive the preconditioner. The list has passed
  /// check_block_preconditioner(). Throws tunica::Error for a strategy that needs an operator
  /// which operators lack.
  BlockPreconditioner(const Teuchos::ParameterList& stratimikos, const algebra::BlockMatrix& K,
                      const NamedOperators& operators);
  ~BlockPreconditioner() override;

  /// Sets up for the present values of K, with what can be kept of the last set-up. Throws
  /// SetupFailure where a block is singular.
  void refresh();

  void apply(const MultiVector& X, MultiVector& Y, Teuchos::ETransp mode = Teuchos::NO_TRANS,
             Scalar alpha = 1.0, Scalar beta = 0.0) const override;
  Teuchos::RCP<const Map> getDomainMap() const override { return blocks_.map(); }
  Teuchos::RCP<const Map> getRangeMap() const override { return blocks_.map(); }

private:
  struct Stack;
  algebra::Concatenation blocks_;
  Teuchos::RCP<Stack> stack_;
};

/// Builds every inverse of the list once, without a matrix. Throws tunica::Error, which lists the
/// known names, for an unknown strategy or inverse or a key that a strategy of ours lacks.
void check_block_preconditioner(const Teuchos::ParameterList& stratimikos);

/// P_R with the two-scale Schur complement and a nodal multigrid cycle for each inverse, with
/// the given sweeps of symmetric Gauss-Seidel before and after the coarse correction.
Teuchos::ParameterList default_block_preconditioner(int velocity_sweeps, int schur_sweeps,
                                                    const std::string& schur = "Two Scale");

}  // namespace tunica::linear
