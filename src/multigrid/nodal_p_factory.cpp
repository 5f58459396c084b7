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
  const auto n_rows = static_cast<long long>(A->getGlobalNumRows());
  // Xpetra asks for a matrix it may change; MueLu leaves prolongators alone.
  const auto P =
      Teuchos::rcp_const_cast<CrsMatrix>(coarsening_->prolongator(fine.GetLevelID(), n_rows));
  Set(coarse, "P", wrapped(P));
}

}  // namespace tunica::multigrid
