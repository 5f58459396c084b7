#include "tunica/multigrid/muelu/nodal_p_factory.hpp"

#include <MueLu_NoFactory.hpp>
#include <stdexcept>
#include <string>

#include "tunica/base/formatted.hpp"
#include "tunica/multigrid/muelu/xpetra.hpp"

namespace tunica::multigrid {

namespace {

constexpr const char* marker = "Nodal Prolongator";

/// Levels that keep more of the unknowns only fill up; small ones do no harm.
constexpr double most_kept = 0.8;
constexpr Tpetra::global_size_t harmless = 5000;

void check_reduction(const CrsMatrix& P, int level) {
  const auto fine = P.getRangeMap()->getGlobalNumElements(),
             kept = P.getDomainMap()->getGlobalNumElements();
  if (fine <= harmless || static_cast<double>(kept) <= most_kept * static_cast<double>(fine))
    return;
  throw std::runtime_error("coarsening stands still: level " + std::to_string(level) + " keeps " +
                           std::to_string(kept) + " of " + std::to_string(fine) + " unknowns");
}

}  // namespace

Teuchos::RCP<const Teuchos::ParameterList> NodalPFactory::GetValidParameterList() const {
  const auto list = Teuchos::rcp(new Teuchos::ParameterList);
  list->set<Teuchos::RCP<const MueLu::FactoryBase>>("A", Teuchos::null, "the matrix to coarsen");
  list->set(rotations, false, "displacements of solids: exact for rigid motions");
  list->set(rotations_from, 0.0,
            "only once a cycle without them has contracted by no more than this factor, in the "
            "mean of the iterations between two set-ups; 0: from the start");
  return list;
}

void NodalPFactory::SetParameterList(const Teuchos::ParameterList& list) {
  MueLu::TwoLevelFactoryBase::SetParameterList(list);
  const double from = GetParameterList().get<double>(rotations_from);
  if (!(from >= 0.0 && from < 1.0))
    throw std::invalid_argument(
        formatted("NodalPFactory: \"%s\" is %g, expected a contraction between 0 and 1.",
                  rotations_from, from));
}

void NodalPFactory::DeclareInput(MueLu::Level& fine, MueLu::Level&) const { Input(fine, "A"); }

void NodalPFactory::Build(MueLu::Level& fine, MueLu::Level& coarse) const {
  // The rows of A say whether it is a block or the whole.
  const auto A = Get<Teuchos::RCP<XMatrix>>(fine, "A");
  // Xpetra asks for a matrix it may change; MueLu leaves prolongators alone.
  const auto P = Teuchos::rcp_const_cast<CrsMatrix>(
      coarsening_->prolongator(fine.GetLevelID(), *Xpetra::toTpetra(A->getRangeMap()),
                               GetParameterList().get<bool>(rotations)));
  check_reduction(*P, coarse.GetLevelID());
  Set(coarse, "P", wrapped(P));
  // The mark of a prolongator that does not depend on values, so that new ones leave it as it is.
  coarse.Set(marker, true, MueLu::NoFactory::get());
}

bool NodalPFactory::made_prolongator_of(MueLu::Level& level) {
  return level.IsAvailable(marker, MueLu::NoFactory::get());
}

}  // namespace tunica::multigrid
