#include "tunica/multigrid/muelu/smoothers/sparse_lu_solver.hpp"

#include <stdexcept>

#include "tunica/base/out_of_memory.hpp"

namespace tunica::multigrid {

Teuchos::RCP<const Teuchos::ParameterList> SparseLuSolver::GetValidParameterList() const {
  const auto list = Teuchos::rcp(new Teuchos::ParameterList);
  list->set<Teuchos::RCP<const MueLu::FactoryBase>>("A", Teuchos::null, "the matrix");
  return list;
}

void SparseLuSolver::set_up(int, const Teuchos::RCP<::tunica::CrsMatrix>& K) {
  lu_ = Teuchos::rcp(new smoothers::SparseLu(K));
  refresh();
}

void SparseLuSolver::refresh() {
  try {
    lu_->refactor();
  } catch (const std::exception& error) {
    // A lack of memory says nothing about the matrix.
    if (is_out_of_memory(error)) throw;
    throw std::runtime_error("the matrix of the coarsest level is singular.");
  }
}

void SparseLuSolver::smooth(const ::tunica::MultiVector& b, ::tunica::MultiVector& x) const {
  lu_->solve(b, x);
}

Teuchos::RCP<MueLu::SmootherPrototype<Scalar, LocalOrdinal, GlobalOrdinal, Node>>
SparseLuSolver::Copy() const {
  return Teuchos::rcp(new SparseLuSolver(*this));
}

}  // namespace tunica::multigrid
