#include "tunica/smoothers/braess_sarazin/sparse_lu.hpp"

#include <Amesos2.hpp>

namespace tunica::smoothers {

Teuchos::RCP<SparseLu> make_sparse_lu(const Teuchos::RCP<const CrsMatrix>& A) {
  const auto lu = Amesos2::create<CrsMatrix, MultiVector>("KLU2", A);
  const Map& rows = *A->getRowMap();
  const auto span = rows.getMaxAllGlobalIndex() - rows.getIndexBase() + 1;
  if (static_cast<GlobalOrdinal>(rows.getGlobalNumElements()) < span) {
    const auto list = Teuchos::rcp(new Teuchos::ParameterList("Amesos2"));
    list->sublist("KLU2").set("IsContiguous", false, "Are GIDs Contiguous");
    lu->setParameters(list);
  }
  lu->symbolicFactorization();
  return lu;
}

void refactor(SparseLu& lu, const Teuchos::RCP<const CrsMatrix>& A) {
  lu.setA(A, Amesos2::SYMBFACT);
  lu.numericFactorization();
}

}  // namespace tunica::smoothers
