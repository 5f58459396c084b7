#include "tunica/linear/amg.hpp"

#include <MueLu_CreateTpetraPreconditioner.hpp>

namespace tunica::linear {

Teuchos::RCP<Operator> make_amg(const Teuchos::RCP<CrsMatrix>& matrix) {
  Teuchos::ParameterList list;
  list.set("verbosity", "none");
  list.set("smoother: type", "CHEBYSHEV");
  list.set("coarse: max size", 500);
  const Teuchos::RCP<Operator> A = matrix;
  return MueLu::CreateTpetraPreconditioner<Scalar, LocalOrdinal, GlobalOrdinal, Node>(A, list);
}

}  // namespace tunica::linear
