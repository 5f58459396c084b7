#include "tunica/multigrid/muelu/smoothers/ifpack2_smoother.hpp"

namespace tunica::multigrid {

Teuchos::RCP<const Teuchos::ParameterList> Ifpack2Smoother::GetValidParameterList() const {
  const auto list = Teuchos::rcp(new Teuchos::ParameterList);
  list->set<Teuchos::RCP<const MueLu::FactoryBase>>("A", Teuchos::null, "the matrix");
  Ifpack2Sweeps::declare(*list);
  return list;
}

void Ifpack2Smoother::set_up(int, const Teuchos::RCP<::tunica::CrsMatrix>& K) {
  sweeps_ = std::make_shared<Ifpack2Sweeps>(GetParameterList(), K);
}

Teuchos::RCP<MueLu::SmootherPrototype<Scalar, LocalOrdinal, GlobalOrdinal, Node>>
Ifpack2Smoother::Copy() const {
  return Teuchos::rcp(new Ifpack2Smoother(*this));
}

}  // namespace tunica::multigrid
