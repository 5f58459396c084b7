#include "multigrid/nodal_p_factory.hpp"

#include "multigrid/xpetra.hpp"

namespace tunica::multigrid {

Teuchos::RCP<const Teuchos::ParameterList> NodalPFactory::GetValidParameterList() const {
  const auto list = Teuchos::rcp(new Teuchos::ParameterList);
  list->set<Teuchos::RCP<const MueLu::FactoryBase>>("A", Teuchos::null, "the matrix to coarsen");
  return list;
}

void NodalPFactory::DeclareInput(MueLu::Level& fine, MueLu::Level&) const { Input(fine, "A"); }

void NodalPFactory::Build(MueLu::Level& fine, MueLu::Level& coarse) const {
  const auto A = Get<Teuchos::RCP<XMatrix>>(fine, "A");
  const int level = fine.GetLevelID();
  const long long n_rows = static_cast<long long>(A->getGlobalNumRows());
  const long long n_nodes = coarsening_->n_nodes(level);
  if (n_rows % n_nodes != 0)
    throw std::runtime_error("NodalPFactory: " + std::to_string(n_rows) + " rows for " +
                             std::to_string(n_nodes) + " nodes.");
  const int dofs = static_cast<int>(n_rows / n_nodes);
  // Xpetra asks for a matrix it may change; MueLu leaves prolongators alone.
  const auto P = Teuchos::rcp_const_cast<CrsMatrix>(coarsening_->prolongator(level, dofs));
  Set(coarse, "P", wrapped(P));
}

}  // namespace tunica::multigrid
