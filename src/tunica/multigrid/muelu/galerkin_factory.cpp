#include "tunica/multigrid/muelu/galerkin_factory.hpp"

#include <MueLu_NoFactory.hpp>
#include <stdexcept>

#include "tunica/base/formatted.hpp"
#include "tunica/multigrid/galerkin/galerkin_product.hpp"
#include "tunica/multigrid/muelu/xpetra.hpp"

namespace tunica::multigrid {

namespace {

constexpr const char* kept_as = "Galerkin Product";

// What C is multiplied by, what it gets, and what it has at least.
constexpr const char *by_factor = "stabilisation scaling", *by_schur = "schur stabilisation",
                     *by_least = "least stabilisation";

/// R = Pᵀ without a matrix of its own: the list says "NoFactory".
bool is_implicit(const GalerkinFactory& factory) {
  return factory.GetFactory("R") == MueLu::NoFactory::getRCP();
}

}  // namespace

Teuchos::RCP<const Teuchos::ParameterList> GalerkinFactory::GetValidParameterList() const {
  const auto list = Teuchos::rcp(new Teuchos::ParameterList);
  for (const char* input : {"A", "P", "R"})
    list->set<Teuchos::RCP<const MueLu::FactoryBase>>(input, Teuchos::null);
  list->set(by_factor, 1.0, "factor of the stabilisation block per level");
  list->set(by_schur, 0.0, "part of B2 diag(A)^-1 B1T that C gets on a coarser level");
  list->set(by_least, 0.0, "part of it below which C is enlarged on a coarser level");
  return list;
}

void GalerkinFactory::SetParameterList(const Teuchos::ParameterList& list) {
  MueLu::TwoLevelFactoryBase::SetParameterList(list);
  for (const char* key : {by_factor, by_schur, by_least})
    if (const double value = GetParameterList().get<double>(key); !(value >= 0.0))
      throw std::invalid_argument(
          formatted("GalerkinFactory: \"%s\" is %g, expected at least 0.", key, value));
}

void GalerkinFactory::DeclareInput(MueLu::Level& fine, MueLu::Level& coarse) const {
  Input(fine, "A");
  Input(coarse, "P");
  if (!is_implicit(*this)) Input(coarse, "R");
}

void GalerkinFactory::Build(MueLu::Level& fine, MueLu::Level& coarse) const {
  const auto A = unwrapped(Get<Teuchos::RCP<XMatrix>>(fine, "A"));
  const auto P = unwrapped(Get<Teuchos::RCP<XMatrix>>(coarse, "P"));
  Teuchos::RCP<const CrsMatrix> R;
  if (!is_implicit(*this)) R = unwrapped(Get<Teuchos::RCP<XMatrix>>(coarse, "R"));
  // A_c = R A P, with more of −C in its scalar block. Only a mixed matrix has such a block.
  const Stabilisation stabilisation{GetParameterList().get<double>(by_factor),
                                    GetParameterList().get<double>(by_schur),
                                    GetParameterList().get<double>(by_least)};
  if (stabilisation.factor != 1.0 || stabilisation.schur > 0.0 || stabilisation.least > 0.0)
    coarsening_->check_mixed(fine.GetLevelID(), *A);
  const Teuchos::RCP<GalerkinProduct> product =
      Teuchos::rcp(new GalerkinProduct(R, A, P, coarsening_->numbering(), stabilisation));
  // The product stays on the level, so that new values of A need no graphs.
  coarse.Set(kept_as, Teuchos::rcp_implicit_cast<algebra::Refreshable>(product),
             MueLu::NoFactory::get());
  Set<Teuchos::RCP<XMatrix>>(coarse, "A", Teuchos::rcp(new LevelMatrix(product->matrix())));
}

Teuchos::RCP<algebra::Refreshable> galerkin_product(MueLu::Level& level) {
  if (!level.IsAvailable(kept_as, MueLu::NoFactory::get())) return Teuchos::null;
  return level.Get<Teuchos::RCP<algebra::Refreshable>>(kept_as, MueLu::NoFactory::get());
}

}  // namespace tunica::multigrid
