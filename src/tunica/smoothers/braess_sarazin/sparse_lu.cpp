#include "tunica/smoothers/braess_sarazin/sparse_lu.hpp"

#include <Amesos2.hpp>
#include <cstdlib>
#include <new>

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

namespace {

/// KLU2 calls a matrix singular also where malloc() fails; it has given back what it took. On the
/// rank of the factors, so that others may not know.
bool lacks_memory_for(const SparseLu& lu) {
  constexpr std::size_t bytes_per_entry = 2 * (sizeof(double) + sizeof(int));  // while growing
  void* const probe = std::malloc(1 + bytes_per_entry * lu.getStatus().getNnzLU());
  std::free(probe);
  return probe == nullptr;
}

}  // namespace

void refactor(SparseLu& lu, const Teuchos::RCP<const CrsMatrix>& A) {
  lu.setA(A, Amesos2::SYMBFACT);
  try {
    lu.numericFactorization();
  } catch (const std::exception&) {
    if (lacks_memory_for(lu)) throw std::bad_alloc();
    throw;
  }
}

}  // namespace tunica::smoothers
