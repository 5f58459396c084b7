#include "tunica/multigrid/muelu/nodal_blocked_p_factory.hpp"

#include <Tpetra_RowMatrixTransposer.hpp>

#include "tunica/multigrid/muelu/blocked_matrix.hpp"

namespace tunica::multigrid {

Teuchos::RCP<const Teuchos::ParameterList> NodalBlockedPFactory::GetValidParameterList() const {
  const auto list = Teuchos::rcp(new Teuchos::ParameterList);
  list->set<Teuchos::RCP<const MueLu::FactoryBase>>("A", Teuchos::null, "the matrix to coarsen");
  return list;
}

void NodalBlockedPFactory::DeclareInput(MueLu::Level& fine, MueLu::Level&) const {
  Input(fine, "A");
}

void NodalBlockedPFactory::Build(MueLu::Level& fine, MueLu::Level& coarse) const {
  const auto A = Teuchos::rcp_dynamic_cast<XBlockedMatrix>(Get<Teuchos::RCP<XMatrix>>(fine, "A"));
  if (A.is_null()) throw std::runtime_error("NodalBlockedPFactory: A is no matrix of blocks.");
  using Transposer = Tpetra::RowMatrixTransposer<Scalar, LocalOrdinal, GlobalOrdinal, Node>;
  // P of all unknowns, cut into its blocks; R = Pᵀ likewise, as MueLu transposes no blocks.
  const auto P =
      coarsening_->prolongator(fine.GetLevelID(), *Xpetra::toTpetra(A->getFullRangeMap()));
  Set<Teuchos::RCP<XMatrix>>(coarse, "P", blocked(*P, coarsening_->numbering()));
  Set<Teuchos::RCP<XMatrix>>(coarse, "R",
                             blocked(*Transposer(P).createTranspose(), coarsening_->numbering()));
}

}  // namespace tunica::multigrid
