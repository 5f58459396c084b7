#include "tunica/linear/amg.hpp"

#include <MueLu_CreateTpetraPreconditioner.hpp>

#include "tunica/linear/setup_failure.hpp"

namespace tunica::linear {

Teuchos::RCP<Operator> make_amg(const Teuchos::RCP<CrsMatrix>& matrix) {
  Teuchos::ParameterList list;
  list.set("verbosity", "none");
  // Chebyshev's polynomials need the largest eigenvalue, and where meshes are irregular ten steps
  // of the power method find it 40 % too small: the cycle diverges then.
  list.set("smoother: type", "RELAXATION");
  list.sublist("smoother: params").set("relaxation: type", "Symmetric Gauss-Seidel");
  list.set("coarse: max size", 500);
  const Teuchos::RCP<Operator> A = matrix;
  Teuchos::RCP<Operator> cycle;
  set_up(*matrix->getComm(), "a multigrid cycle for one unknown per node", [&] {
    cycle = MueLu::CreateTpetraPreconditioner<Scalar, LocalOrdinal, GlobalOrdinal, Node>(A, list);
  });
  return cycle;
}

}  // namespace tunica::linear
