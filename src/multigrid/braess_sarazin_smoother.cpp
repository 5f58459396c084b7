#include "multigrid/braess_sarazin_smoother.hpp"

#include "multigrid/chosen_word.hpp"
#include "multigrid/mixed_blocks.hpp"

namespace tunica::multigrid {

namespace {

BraessSarazinOptions options_of(const Teuchos::ParameterList& list) {
  BraessSarazinOptions options;
  options.sweeps = list.get<int>("sweeps");
  options.scaling = list.get<double>("scaling");
  options.damping = list.get<double>("damping");
  options.schur = chosen_word("NodalBraessSarazinSmoother", list, "schur",
                              {"gauss-seidel", "chebyshev", "direct"});
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

void NodalBraessSarazinSmoother::DeclareInput(MueLu::Level& level) const {
  this->Input(level, "A");
}

void NodalBraessSarazinSmoother::SetParameterList(const Teuchos::ParameterList& list) {
  SmootherPrototype::SetParameterList(list);
  options_of(GetParameterList());
}

void NodalBraessSarazinSmoother::Setup(MueLu::Level& level) {
  K_ = unwrapped(this->Get<Teuchos::RCP<XMatrix>>(level, "A"));
  check_mixed(*K_);
  smoother_ = std::make_shared<BraessSarazin>(*K_, options_of(this->GetParameterList()));
  this->IsSetup(true);
}

void NodalBraessSarazinSmoother::Apply(XMultiVector& x, const XMultiVector& b, bool is_zero) const {
  if (is_zero) x.putScalar(0.0);
  smoother_->smooth(*unwrapped(b), *unwrapped(x));
}

Teuchos::RCP<MueLu::SmootherPrototype<Scalar, LocalOrdinal, GlobalOrdinal, Node>>
NodalBraessSarazinSmoother::Copy() const {
  return Teuchos::rcp(new NodalBraessSarazinSmoother(*this));
}

std::size_t NodalBraessSarazinSmoother::getNodeSmootherComplexity() const {
  return K_->getNodeNumEntries();
}

}  // namespace tunica::multigrid
