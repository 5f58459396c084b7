#pragma once
#include "tunica/base/types.hpp"

namespace tunica::linear {

/// Incomplete LU factors of a distributed matrix, additive Schwarz between the ranks
/// (Ifpack2). refresh() factors the present values.
class IluPreconditioner {
public:
  IluPreconditioner(const Teuchos::RCP<const CrsMatrix>& matrix, int fill_level, int overlap);
  ~IluPreconditioner();

  void refresh();
  Teuchos::RCP<Operator> as_operator() const;

private:
  struct Factors;
  Teuchos::RCP<Factors> factors_;
};

}  // namespace tunica::linear
