#include "multigrid/braess_sarazin_smoother.hpp"

#include "multigrid/chosen_word.hpp"

namespace tunica::multigrid {

namespace {

BraessSarazinOptions options_of(const Teuchos::ParameterList& list) {
  BraessSarazinOptions options;
  options.sweeps = list.get<int>("sweeps");
  options.scaling = list.get<double>("scaling");
  options.damping = list.get<double>("damping");
  options.schur = chosen_word("NodalBraessSarazinSmoother", list, "schur",
                              {"gauss-seidel", "chebyshev", "multigrid", "direct"});
  options.schur_sweeps = list.get<int>("schur sweeps");
  const bool is_valid = options.sweeps > 0 && options.schur_sweeps > 0 && options.scaling > 0.0 &&
                        options.damping > 0.0;
  if (!is_valid)
    throw std::invalid_argument(
        "NodalBraessSarazinSmoother: \"sweeps\", \"schur sweeps\", \"scaling\" and \"damping\" "
        "must be positive.");
  return options;
}

}  // namespace

Teuchos::RCP<const Teuchos::ParameterList> NodalBraessSarazinSmoother::GetValidParameterList()
    const {
  const auto list = Teuchos::rcp(new Teuchos::ParameterList);
  list->set<Teuchos::RCP<const MueLu::FactoryBase>>("A", Teuchos::null, "the mixed matrix");
  list->set("sweeps", 1);
  list->set("scaling", 2.0);
  list->set("damping", 1.0);
  list->set<std::string>("schur", "gauss-seidel");
  list->set("schur sweeps", 2);
  return list;
}

void NodalBraessSarazinSmoother::check(const Teuchos::ParameterList& list) const {
  options_of(list);
}

void NodalBraessSarazinSmoother::set_up(const ::tunica::CrsMatrix& K,
                                        const MixedNumbering& numbering) {
  smoother_ = std::make_shared<BraessSarazin>(K, numbering, options_of(GetParameterList()));
}

void NodalBraessSarazinSmoother::smooth(const ::tunica::MultiVector& b,
                                        ::tunica::MultiVector& x) const {
  smoother_->smooth(b, x);
}

Teuchos::RCP<MueLu::SmootherPrototype<Scalar, LocalOrdinal, GlobalOrdinal, Node>>
NodalBraessSarazinSmoother::Copy() const {
  return Teuchos::rcp(new NodalBraessSarazinSmoother(*this));
}

}  // namespace tunica::multigrid
