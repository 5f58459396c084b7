#include "multigrid/stabilised_rap_factory.hpp"

#include "multigrid/xpetra.hpp"

namespace tunica::multigrid {

namespace {

using Galerkin = MueLu::RAPFactory<Scalar, LocalOrdinal, GlobalOrdinal, Node>;

void scale_stabilisation(CrsMatrix& K, const MixedNumbering& numbering, double factor) {
  const auto domain = K.getDomainMap(), range = K.getRangeMap();
  K.resumeFill();
  {
    const auto local = K.getLocalMatrixHost();
    for (int i = 0; i < local.numRows(); ++i) {
      if (!numbering.is_scalar(K.getRowMap()->getGlobalElement(i))) continue;
      auto row = local.row(i);
      for (int k = 0; k < row.length; ++k)
        if (numbering.is_scalar(K.getColMap()->getGlobalElement(row.colidx(k))))
          row.value(k) *= factor;
    }
  }
  K.fillComplete(domain, range);
}

}  // namespace

Teuchos::RCP<const Teuchos::ParameterList> StabilisedRapFactory::GetValidParameterList() const {
  const auto list = Teuchos::rcp(new Teuchos::ParameterList(*Galerkin::GetValidParameterList()));
  list->set("stabilisation scaling", 1.0, "factor of the stabilisation block per level");
  return list;
}

void StabilisedRapFactory::Build(MueLu::Level& fine, MueLu::Level& coarse) const {
  Galerkin::Build(fine, coarse);
  const double factor = GetParameterList().get<double>("stabilisation scaling");
  if (factor == 1.0) return;
  const auto K = coarse.Get<Teuchos::RCP<XMatrix>>("A", this);
  coarsening_->check_mixed(coarse.GetLevelID(), *unwrapped(K));
  scale_stabilisation(*unwrapped(K), coarsening_->numbering(), factor);
}

}  // namespace tunica::multigrid
